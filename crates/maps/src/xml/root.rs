//! The outermost element of a file, told by its first bytes.

use memchr::memmem;

/// The name of the outermost element of XML that begins with these bytes, if it is among them.
pub(crate) fn root(start: &[u8]) -> Option<&str> {
    let mut rest = start.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(start).trim_ascii_start();
    // Declarations and comments stand before it.
    loop {
        let closing: &[u8] = match rest {
            [b'<', b'?', ..] => b"?>",
            [b'<', b'!', b'-', b'-', ..] => b"-->",
            [b'<', b'!', ..] => b">",
            _ => break,
        };
        rest = rest[memmem::find(rest, closing)? + closing.len()..].trim_ascii_start();
    }
    let name = rest.strip_prefix(b"<")?;
    let end = name.iter().position(|it| !(it.is_ascii_alphanumeric() || b"_-.:".contains(it)))?;
    str::from_utf8(&name[..end]).ok()
}
