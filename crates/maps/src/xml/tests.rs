use super::*;

/// Records what it receives.
#[derive(Default)]
struct Notes(Vec<String>);

impl Visitor for Notes {
    fn open(&mut self, path: &str, element: &Element) -> Result<(), XmlError> {
        let [id] = element.values(["id"])?;
        self.0.push(format!("{}: <{path} {}>", element.line, id.unwrap_or_default()));
        Ok(())
    }

    fn close(&mut self, path: &str, text: &str) {
        self.0.push(format!("{path}={text}"));
    }
}

fn refusal(text: &str) -> String {
    walk(text.as_bytes(), "r", &mut Notes::default()).unwrap_err().to_string()
}

#[test]
fn elements_come_with_path_line_and_text() {
    let mut notes = Notes::default();
    let text = concat!(
        "\u{feff}<?xml version='1.0'?>\n<r id='0'>\n <a>\n",
        "  <b id='&lt;'/> 1&#46;<![CDATA[5]]>&amp; </a>\n</r>\n"
    );
    walk(text.as_bytes(), "r", &mut notes).unwrap();
    assert_eq!(notes.0, ["2: < 0>", "3: <a >", "4: <a/b <>", "a/b=", "a=1.5&", "="]);
}

#[test]
fn what_is_no_such_document_is_refused_with_its_line() {
    assert_eq!(
        refusal("\n<osm/>"),
        "line 2: the outermost element is <osm>, not <r>; is this a file of another format?"
    );
    assert!(refusal("").starts_with("line 1: the outermost element is <>"));
    assert!(refusal("<r/>\n<r/>").starts_with("line 2: not well-formed XML (there is a second"));
    assert!(refusal("<r>\n<a>").starts_with("line 2: not well-formed XML (the file ends inside"));
    assert!(refusal("<r>\n\n</a></r>").starts_with("line 3: not well-formed XML"));
    assert!(refusal(&"<r>".repeat(33)).contains("nested too deeply"));
    assert!(refusal("<r>\n<a>&#0;</a></r>").starts_with("line 2: not well-formed XML"));
}

#[test]
fn names_are_no_longer_than_128_bytes() {
    let named = |length: usize| format!("<r>\n<{}/></r>", "a".repeat(length));
    assert_eq!(walk(named(128).as_bytes(), "r", &mut Notes::default()), Ok(()));
    assert_eq!(
        refusal(&named(129)),
        "line 2: not well-formed XML (the name of an element is too long); save the file again, or correct this line"
    );
}

#[test]
fn entities_of_a_documents_own_are_not_expanded() {
    let bomb = "<!DOCTYPE r [<!ENTITY a 'aa'>\n<!ENTITY b '&a;&a;'>]>\n<r>\n<a>&b;</a></r>";
    assert_eq!(
        refusal(bomb),
        "line 4: not well-formed XML (the entity &b; is unknown); save the file again, or correct this line"
    );
}

#[test]
fn the_names_and_closings_of_empty_elements_do_not_mix() {
    let mut notes = Notes::default();
    walk(b"<r ><a id='/'/><b id='>'  /><c/></r >", "r", &mut notes).unwrap();
    assert_eq!(notes.0, ["1: < >", "1: <a />", "a=", "1: <b >>", "b=", "1: <c >", "c=", "="]);
}

#[test]
fn bytes_that_are_no_text_are_refused_with_their_line() {
    let error = walk(b"<r>\n\xff</r>", "r", &mut Notes::default()).unwrap_err();
    assert!(error.to_string().starts_with("line 2: the bytes are not UTF-8"));
}
