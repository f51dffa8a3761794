//! Texts for the keys and values of a scenario, from its schema.

use serde_json::Value;

/// Maximum length of a line of prose.
const WIDTH: usize = 100;

/// The kind of content of a key.
pub(super) enum Kind<'a> {
    /// A plain value.
    Value,
    /// One of some words.
    Choice(&'a [Value]),
    /// A table of several kinds; one of its keys names the kind.
    Tagged(&'a [Value]),
    /// A table of keys.
    Table(&'a Value),
    /// A list of tables.
    List(&'a Value),
    /// A table whose keys are names.
    Names,
}

impl<'a> Kind<'a> {
    /// The possible words, or the possible kinds of tables.
    pub(super) fn choices(&self) -> &'a [Value] {
        match self {
            Kind::Choice(all) | Kind::Tagged(all) => all,
            _ => &[],
        }
    }
}

/// The content of the key with the schema `property`, with the definitions in `schema`.
pub(super) fn kind<'a>(schema: &'a Value, property: &'a Value) -> Kind<'a> {
    let of = resolved(schema, property);
    if of["properties"].is_object() {
        return Kind::Table(of);
    }
    if of["additionalProperties"].is_object() {
        return Kind::Names;
    }
    let element = resolved(schema, &of["items"]);
    if element["properties"].is_object() {
        return Kind::List(element);
    }
    match of["oneOf"].as_array() {
        Some(all) if all.iter().all(|it| it["properties"].is_object()) => Kind::Tagged(all),
        Some(all) => Kind::Choice(all),
        None => Kind::Value,
    }
}

/// The schema behind a reference; of an optional value, the schema of the value.
fn resolved<'a>(schema: &'a Value, property: &'a Value) -> &'a Value {
    let some = property["anyOf"].as_array().and_then(|all| all.iter().find(|it| it["type"] != "null"));
    let it = some.unwrap_or(property);
    let name = it["$ref"].as_str().and_then(|it| it.strip_prefix("#/$defs/"));
    name.map_or(it, |name| &schema["$defs"][name])
}

/// The description of a key in the schema.
pub(super) fn meaning(property: &Value) -> String {
    property["description"].as_str().unwrap_or_default().replace('\n', " ")
}

/// One of the choices, with its description in the schema.
pub(super) fn described(choice: &Value) -> String {
    let word = match choice["properties"].as_object() {
        None => inline(&choice["const"]),
        Some(properties) => {
            let (tag, rest): (Vec<_>, Vec<_>) = properties.iter().partition(|(_, it)| !it["const"].is_null());
            let tag = tag.into_iter().map(|(name, it)| format!("{name} = {}", inline(&it["const"])));
            let rest = rest.into_iter().map(|(name, it)| format!("{name} = {}", inline(&it["default"])));
            format!("{{ {} }}", tag.chain(rest).collect::<Vec<_>>().join(", "))
        }
    };
    let keys = choice["properties"].as_object().into_iter().flatten().filter(|(_, it)| it["const"].is_null());
    let keys = keys.map(|(name, it)| format!(" {name}: {}", meaning(it)));
    format!("{word}: {}{}", meaning(choice), keys.collect::<String>())
}

/// `text` as lines of prose, `inset` after their `#`.
pub(super) fn comment(text: &str, inset: &str) -> String {
    let (mut lines, mut line) = (String::new(), format!("#{inset}"));
    for word in text.split_whitespace() {
        if line.chars().count() + 1 + word.chars().count() > WIDTH {
            lines += &line;
            lines += "\n";
            // A continuation stands below the beginning.
            line = format!("#{inset}{inset}");
        }
        line += " ";
        line += word;
    }
    lines + &line + "\n"
}

/// A value as TOML on one line.
pub(super) fn inline(value: &Value) -> String {
    match value {
        Value::Array(all) => format!("[{}]", all.iter().map(inline).collect::<Vec<_>>().join(", ")),
        Value::Object(all) => {
            let all: Vec<String> =
                all.iter().map(|(name, it)| format!("{} = {}", key(name), inline(it))).collect();
            format!("{{ {} }}", all.join(", "))
        }
        plain => plain.to_string(),
    }
}

/// A name as a key of TOML.
pub(super) fn key(name: &str) -> String {
    let is_bare = |it: char| it.is_ascii_alphanumeric() || matches!(it, '-' | '_');
    let needs_no_quotes = !name.is_empty() && name.chars().all(is_bare);
    if needs_no_quotes { name.into() } else { Value::from(name).to_string() }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn values_read_as_in_toml() {
        assert_eq!(inline(&json!({"a": [1.0, 2], "b c": "x\"y"})), r#"{ a = [1.0, 2], "b c" = "x\"y" }"#);
    }

    #[test]
    fn prose_is_wrapped_and_hangs_below_its_beginning() {
        let text = comment(&"word ".repeat(30), "  ");
        assert!(text.lines().all(|it| it.chars().count() <= WIDTH));
        assert!(text.starts_with("#   word") && text.lines().nth(1).unwrap().starts_with("#     word"));
    }
}
