//! Pages for a browser. Each page is one text with its style, code and data.

/// The style sheet of the chart library, and the style sheet that all pages share.
const STYLES: [&str; 2] = [include_str!("../web/uplot/uPlot.min.css"), include_str!("../web/shared.css")];
/// The chart library.
const CHART_LIBRARY: &str = include_str!("../web/uplot/uPlot.iife.min.js");

/// Returns the page of results with the given heading. `data` is JSON for the code of the page.
pub fn results(heading: &str, data: &str) -> String {
    let script = include_str!(concat!(env!("OUT_DIR"), "/results.js"));
    filled(include_str!("../web/results.html"), heading, include_str!("../web/results.css"), data, script)
}

/// Returns the live page with the given heading. `data` is JSON for the code of the page.
#[cfg(feature = "server")]
pub(crate) fn live(heading: &str, data: &str) -> String {
    let script = include_str!(concat!(env!("OUT_DIR"), "/live.js"));
    filled(include_str!("../web/live.html"), heading, include_str!("../web/live.css"), data, script)
}

/// Returns the text `html` after the heading, the style, the data and the script have replaced its
/// placeholders.
fn filled(html: &str, heading: &str, style: &str, data: &str, script: &str) -> String {
    let mut page = String::new();
    // The parts are inserted in one pass, so inserted text is not searched again.
    for (number, part) in html.split("{{").enumerate() {
        let Some((name, rest)) = part.split_once("}}").filter(|_| number > 0) else {
            page += part;
            continue;
        };
        match name {
            "title" => page += &escaped(heading),
            "style" => page.extend(STYLES.into_iter().chain([style]).flat_map(|text| [text, "\n"])),
            "data" => page += &script_safe(data),
            _ => page.extend(["\"use strict\";\n", CHART_LIBRARY, "\nconst modules = {};\n", script]),
        }
        page += rest;
    }
    page
}

/// Returns JSON that is safe in a script. Without the character `<`, no text in the JSON can end the script
/// or start another script.
fn script_safe(json: &str) -> String {
    json.replace('<', "\\u003c").replace('>', "\\u003e").replace('&', "\\u0026")
}

/// Returns a text in which characters with a meaning in HTML, such as `<`, are escaped.
fn escaped(text: &str) -> String {
    let mut out = String::new();
    for letter in text.chars() {
        match letter {
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '&' => out.push_str("&amp;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            _ => out.push(letter),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn titles_are_no_markup() {
        assert_eq!(escaped("<b a=\"'\">&"), "&lt;b a=&quot;&#39;&quot;&gt;&amp;");
    }

    #[test]
    fn texts_cannot_end_the_script() {
        let page = results("title", r#"{"name":"</script>&{{title}}"}"#);
        assert!(page.contains(r#"{"name":"\u003c/script\u003e\u0026{{title}}"}"#));
        assert_eq!(page.matches("</script>").count(), 2);
    }
}
