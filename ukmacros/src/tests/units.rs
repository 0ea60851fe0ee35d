//! Units: what is accepted, what is refused, and what becomes of them.

use super::expand;

#[test]
#[ignore]
fn try_out() {
    let text = std::fs::read_to_string("/tmp/h-units/try.txt").unwrap();
    for source in text.split("\n---\n") {
        let (code, errors) = expand(source);
        println!("== {}", source.lines().next().unwrap());
        for e in &errors {
            let (s, t) = (e.loc.start.start(), e.loc.end.end());
            let line = source.lines().nth(s.line - 1).unwrap_or("");
            let shown: String = line
                .chars()
                .skip(s.column)
                .take(if t.line == s.line {
                    t.column - s.column
                } else {
                    40
                })
                .collect();
            println!("  {}:{} `{shown}`: {}", s.line, s.column, e.message);
        }
        if errors.is_empty() {
            let text = code.to_string();
            for piece in text.split("unit :").skip(1) {
                print!(" {}", piece.split('}').next().unwrap());
            }
            if let Some(c) = text.split("coordinate_units :").nth(1) {
                println!("  | {}", c.split(']').next().unwrap());
            }
        }
    }
}
