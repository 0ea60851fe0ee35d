//! `uk stability`.

use super::*;

#[test]
fn some_cases_write_their_page_picture_and_tables() {
    let scratch = Scratch::new("stability");
    let out = scratch.0.to_str().expect("UTF-8");
    let table = output(&["stability", "not-finite", "rows-near", "--out", out]);
    for words in ["rows-near", "not-finite", "NonFinite", "0 wrong"] {
        assert!(table.contains(words), "{words}: {table}");
    }
    let read = |name: &str| fs::read_to_string(scratch.0.join(name)).expect(name);
    let json: Value = serde_json::from_str(&read("stability.json")).expect("JSON");
    let cases = json["cases"].as_array().expect("cases");
    // In the order of the table, whatever the order asked for.
    let ids: Vec<&str> = cases.iter().filter_map(|c| c["id"].as_str()).collect();
    assert_eq!(ids, ["rows-near", "not-finite"]);
    let points: usize = cases
        .iter()
        .map(|c| c["points"].as_array().expect("points").len())
        .sum();
    assert_eq!(read("stability.csv").lines().count(), points + 1);
    let (page, picture) = (read("index.html"), read("stability.svg"));
    assert!(page.contains("stability.svg") && page.contains("not a finite number: parameter m"));
    assert!(picture.starts_with("<svg ") && picture.contains("rows-near"));
}

#[test]
fn a_case_that_is_not_there_is_a_usage_error() {
    let message = "no case is called `turn`; did you mean `turns`?";
    fails(&["stability", "turn"], USAGE, message);
}
