//! Pages that need nothing but themselves and the files they name: sections, tables, figures, numbers.

use maud::{DOCTYPE, Markup, PreEscaped, Render, html};

use crate::numbers;

/// A number with `digits` decimals and a real minus sign; what rounds to zero has no sign.
#[must_use]
pub fn fixed(value: f64, digits: usize) -> String {
    numbers::fixed(value, digits).replace('-', "−")
}

/// A number with `digits` decimals and its sign, `+` or a real minus; what rounds to zero has none.
#[must_use]
pub fn signed(value: f64, digits: usize) -> String {
    let text = fixed(value, digits);
    if text.starts_with('−') || text.bytes().all(|b| b == b'0' || b == b'.') {
        text
    } else {
        format!("+{text}")
    }
}

/// A number as a·10ᵇ with two digits, as HTML; `∞` and words for what is not finite.
#[must_use]
pub fn power_of_ten(value: f64) -> Markup {
    if !value.is_finite() {
        return html! { (if value.is_nan() { "no number" } else { "∞" }) };
    }
    let text = format!("{value:.1e}").replace('-', "−");
    match text.split_once('e') {
        _ if value == 0.0 => html! { "0" },
        Some(("1.0", exponent)) => html! { "10" sup { (exponent) } },
        Some((mantissa, exponent)) => html! { (mantissa) "·10" sup { (exponent) } },
        None => html! { (text) },
    }
}

/// A message of a command as HTML: names between backticks are code.
#[must_use]
pub fn message(text: &str) -> Markup {
    html! {
        @for (k, part) in text.split('`').enumerate() {
            @if k % 2 == 1 { code { (part) } } @else { (part) }
        }
    }
}

/// The values as one text, with commas between them.
#[must_use]
pub fn joined(values: impl IntoIterator<Item = String>) -> String {
    values.into_iter().collect::<Vec<_>>().join(", ")
}

/// A cell of a table.
#[derive(Debug, Clone)]
pub enum Cell {
    /// Text, left-aligned.
    Text(Markup),
    /// A number, right-aligned in figures of equal width.
    Number(Markup),
    /// Text with a class of the style sheet.
    Class(&'static str, Markup),
    /// Text across all columns that are left.
    Rest(Markup),
    /// Nothing is known. A column in which that is so throughout is left out.
    Missing,
}

impl Cell {
    /// A cell of text.
    pub fn text(content: impl Render) -> Self {
        Cell::Text(content.render())
    }

    /// A cell of a number.
    pub fn number(content: impl Render) -> Self {
        Cell::Number(content.render())
    }

    /// A cell of a number with `digits` decimals.
    #[must_use]
    pub fn fixed(value: f64, digits: usize) -> Self {
        Cell::number(fixed(value, digits))
    }

    /// A cell of a small number, as a·10ᵇ.
    #[must_use]
    pub fn power(value: f64) -> Self {
        Cell::Number(power_of_ten(value))
    }

    /// The cell that `cell` makes of `value`, if there is one.
    pub fn or_missing<T>(value: Option<T>, cell: impl FnOnce(T) -> Cell) -> Self {
        value.map_or(Cell::Missing, cell)
    }
}

/// A table. `heads` are the heads of its columns, with `|` between them; columns under a common head are written `head: one; two`. Heads
/// are HTML of ours, and not escaped.
#[must_use]
pub fn table(
    caption: impl Render,
    heads: &str,
    rows: impl IntoIterator<Item = Vec<Cell>>,
) -> Markup {
    let rows: Vec<Vec<Cell>> = rows.into_iter().collect();
    let known = |column: usize| {
        let mut cells = rows.iter().filter_map(|row| row.get(column));
        rows.is_empty() || cells.any(|cell| !matches!(cell, Cell::Missing))
    };
    // A column of text is aligned as such, with its head and where it has nothing.
    let text = |column: usize| {
        let cells = || rows.iter().filter_map(|row| row.get(column));
        cells().all(|cell| !matches!(cell, Cell::Number(_)))
            && cells().any(|cell| !matches!(cell, Cell::Missing))
    };
    let heads = heads.split('|').flat_map(|head| {
        let (group, members) = head.split_once(": ").unwrap_or(("", head));
        members
            .split(';')
            .map(move |member| (group.trim(), member.trim()))
    });
    let heads: Vec<(usize, (&str, &str))> = heads.enumerate().filter(|(k, _)| known(*k)).collect();
    let groups = || heads.chunk_by(|(_, (one, _)), (_, (other, _))| one == other);
    html! {
        figure.table {
            figcaption { (caption) }
            div.scroll { table {
                thead {
                    @if heads.iter().any(|(_, (group, _))| !group.is_empty()) {
                        tr { @for group in groups() { (group_head(group[0].1.0, group.len())) } }
                    }
                    tr { @for (k, (_, head)) in &heads { th class=[text(*k).then_some("text")] { (PreEscaped(head)) } } }
                }
                tbody { @for row in &rows { tr {
                    @for (left, (k, _)) in (1..=heads.len()).rev().zip(&heads) {
                        @if let Some(cell) = row.get(*k) { (data(cell, left, text(*k))) }
                    }
                } } }
            } }
        }
    }
}

/// A head above so many columns.
fn group_head(group: &str, columns: usize) -> Markup {
    html! {
        @if group.is_empty() { @for _ in 0..columns { th {} } }
        @else if columns > 0 { th.group colspan=(columns) { (PreEscaped(group)) } }
    }
}

/// A cell with so many columns from it to the end, in a column of text or not.
fn data(cell: &Cell, left: usize, text: bool) -> Markup {
    match cell {
        Cell::Text(content) => html! { td { (content) } },
        Cell::Number(content) => html! { td.n { (content) } },
        Cell::Class(class, content) => html! { td class=(class) { (content) } },
        Cell::Rest(content) => html! { td colspan=(left) { (content) } },
        Cell::Missing => html! { td class=[(!text).then_some("n")] { "–" } },
    }
}

/// A figure: an image file beside the page, and a caption. `text` describes it to who cannot see it.
#[must_use]
pub fn figure(file: &str, text: &str, caption: impl Render) -> Markup {
    figure_of("", file, text, caption)
}

/// A figure with a class of the style sheet: `wide` across the page, `tall` beside two others.
#[must_use]
pub fn figure_of(class: &str, file: &str, text: &str, caption: impl Render) -> Markup {
    html! {
        figure class=[(!class.is_empty()).then_some(class)] {
            div.scroll { img src=(file) alt=(text); }
            figcaption { (caption) }
        }
    }
}

/// A page within the page: an HTML file beside it, and a caption with a link to it.
#[must_use]
pub fn embedded(file: &str, text: &str, caption: impl Render) -> Markup {
    html! {
        figure.wide {
            iframe src=(file) title=(text) loading="lazy" {}
            figcaption { (caption) " " a href=(file) { "By itself." } }
        }
    }
}

/// A part of a page: its anchor, the text of the link to it at the top of the page, its heading, which is numbered; and what follows. Where
/// that is empty the part is not written at all.
pub type Section = ([&'static str; 3], Markup);

/// A page of numbered sections that are linked at its top, in the style of reports.
#[derive(Debug, Clone)]
pub struct Page<'a> {
    /// The title of the page, which is its first heading, too.
    pub title: &'a str,
    /// What stands between the heading and the links.
    pub head: Markup,
    /// Files beside the page that are linked: their names, and the texts of the links.
    pub files: &'a [(&'a str, &'a str)],
    /// The sections, in order.
    pub sections: Vec<Section>,
    /// The last lines of the page.
    pub foot: Markup,
}

impl Page<'_> {
    /// Writes the page as the text of an HTML file that needs nothing but itself and the files it names.
    #[must_use]
    pub fn render(&self) -> String {
        let shown = || self.sections.iter().filter(|(_, body)| !body.0.is_empty());
        let body = html! {
            h1 { (self.title) }
            (self.head)
            nav {
                @for ([id, link, _], _) in shown() { a href=(format!("#{id}")) { (link) } " " }
                @for (file, text) in self.files { a href=(file) { (text) } " " }
            }
            @for (k, ([id, _, title], body)) in shown().enumerate() {
                h2 id=(id) { (k + 1) ". " (title) }
                (body)
            }
            (self.foot)
        };
        document(self.title, STYLE, &body)
    }
}

/// The text of an HTML file that needs nothing but itself: its title, style sheet and body.
#[must_use]
pub fn document(title: &str, style: &str, body: &Markup) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                style { (PreEscaped(style)) }
            }
            body { (body) }
        }
    };
    page.into_string()
}

const STYLE: &str = include_str!("page.css");

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_well() {
        assert_eq!(fixed(-199.24, 1), "−199.2");
        assert_eq!(fixed(-0.0001, 3), "0.000");
        assert_eq!(signed(0.0004, 3), "0.000");
        assert_eq!(signed(0.0006, 3), "+0.001");
        for (value, text) in [
            (-2.34e-13, "−2.3·10<sup>−13</sup>"),
            (1e-10, "10<sup>−10</sup>"),
            (0.0, "0"),
        ] {
            assert_eq!(power_of_ten(value).into_string(), text);
        }
    }

    #[test]
    fn what_html_reserves_is_escaped() {
        assert_eq!(
            message("`a<b` & c").into_string(),
            "<code>a&lt;b</code> &amp; c"
        );
        let figure = figure("a.svg", "x < 1", "b & c").into_string();
        assert!(
            figure.contains("alt=\"x &lt; 1\"") && figure.contains("b &amp; c"),
            "{figure}"
        );
    }

    #[test]
    fn a_table_has_its_cells_but_no_empty_column() {
        let row = |name, cell| vec![Cell::text(name), Cell::Missing, cell, Cell::Missing];
        let rows = [
            row("a", Cell::fixed(1.0, 0)),
            row("b", Cell::Rest(html! { i { "no" } })),
        ];
        let html = table("c", "name | both: here; there | nowhere: x", rows).into_string();
        assert!(
            html.contains("<th class=\"group\" colspan=\"1\">both</th>"),
            "{html}"
        );
        assert!(
            html.contains("<th class=\"text\">name</th><th>there</th></tr>"),
            "{html}"
        );
        assert!(html.contains("<td>a</td><td class=\"n\">1</td>"), "{html}");
        assert!(html.contains("<td colspan=\"1\"><i>no</i></td>"), "{html}");
    }

    #[test]
    fn a_page_links_what_it_has() {
        let section = |id, body| ([id, id, "Title"], body);
        let page = Page {
            title: "A & B",
            head: html! {},
            files: &[("a.json", "JSON")],
            sections: vec![
                section("empty", html! {}),
                section("full", html! { p { "text" } }),
            ],
            foot: html! {},
        };
        let html = page.render();
        assert!(
            html.contains("<title>A &amp; B</title>") && !html.contains("empty"),
            "{html}"
        );
        assert!(
            html.contains("<a href=\"#full\">full</a>")
                && html.contains("<h2 id=\"full\">1. Title</h2>")
        );
    }
}
