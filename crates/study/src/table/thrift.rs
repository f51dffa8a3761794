//! How long a structure in Thrift's compact protocol is, without what it says. Its work is in proportion to the bytes:
//! a list that claims more elements than there are bytes is none.

/// No structure of a table is nested so deep.
const DEEPEST: usize = 24;

/// The types of the protocol (Thrift compact protocol specification).
mod kind {
    pub(super) const TRUE: u8 = 1;
    pub(super) const FALSE: u8 = 2;
    pub(super) const BYTE: u8 = 3;
    pub(super) const I16: u8 = 4;
    pub(super) const I64: u8 = 6;
    pub(super) const DOUBLE: u8 = 7;
    pub(super) const BINARY: u8 = 8;
    pub(super) const LIST: u8 = 9;
    pub(super) const SET: u8 = 10;
    pub(super) const MAP: u8 = 11;
    pub(super) const STRUCTURE: u8 = 12;
}

/// The length of the structure at the begin of `bytes`. Its fields that are whole numbers are shown to `number`, by
/// their ids. `None` if `bytes` do not begin with a whole structure.
pub(super) fn length(bytes: &[u8], mut number: impl FnMut(i64, i64)) -> Option<usize> {
    let mut reader = Reader { rest: bytes };
    reader.structure(0, &mut number)?;
    Some(bytes.len() - reader.rest.len())
}

/// What has not been read yet.
struct Reader<'a> {
    rest: &'a [u8],
}

impl Reader<'_> {
    fn skip(&mut self, count: u64) -> Option<()> {
        self.rest = self.rest.get(usize::try_from(count).ok()?..)?;
        Some(())
    }

    fn byte(&mut self) -> Option<u8> {
        let (first, rest) = self.rest.split_first()?;
        self.rest = rest;
        Some(*first)
    }

    fn varint(&mut self) -> Option<u64> {
        let mut value = 0;
        for shift in (0..64).step_by(7) {
            let byte = self.byte()?;
            value |= u64::from(byte & 0x7f) << shift;
            if byte < 0x80 {
                return Some(value);
            }
        }
        None
    }

    fn whole(&mut self) -> Option<i64> {
        let coded = self.varint()?;
        Some((coded >> 1) as i64 ^ -((coded & 1) as i64))
    }

    fn structure(&mut self, depth: usize, number: &mut dyn FnMut(i64, i64)) -> Option<()> {
        let mut id = 0;
        loop {
            let head = self.byte()?;
            if head == 0 {
                return Some(());
            }
            let step = i64::from(head >> 4);
            id = if step == 0 { self.whole()? } else { id + step };
            match head & 0xf {
                kind::TRUE | kind::FALSE => {}
                kind::I16..=kind::I64 => number(id, self.whole()?),
                other => self.value(other, depth + 1)?,
            }
        }
    }

    /// A value that is no field: also true and false take a byte.
    fn value(&mut self, of: u8, depth: usize) -> Option<()> {
        if depth > DEEPEST {
            return None;
        }
        match of {
            kind::TRUE | kind::FALSE | kind::BYTE => self.skip(1),
            kind::I16..=kind::I64 => self.whole().map(drop),
            kind::DOUBLE => self.skip(8),
            kind::BINARY => {
                let count = self.varint()?;
                self.skip(count)
            }
            kind::LIST | kind::SET => {
                let head = self.byte()?;
                let count = if head >> 4 == 15 { self.varint()? } else { u64::from(head >> 4) };
                self.values(count, &[head & 0xf], depth)
            }
            kind::MAP => match self.varint()? {
                0 => Some(()),
                count => {
                    let kinds = self.byte()?;
                    self.values(count, &[kinds >> 4, kinds & 0xf], depth)
                }
            },
            kind::STRUCTURE => self.structure(depth, &mut |_, _| ()),
            _ => None,
        }
    }

    /// So many values of each of these kinds, in turn.
    fn values(&mut self, count: u64, kinds: &[u8], depth: usize) -> Option<()> {
        // Each takes at least a byte.
        if count > self.rest.len() as u64 {
            return None;
        }
        (0..count).try_for_each(|_| kinds.iter().try_for_each(|it| self.value(*it, depth + 1)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(bytes: &[u8]) -> Option<(usize, Vec<(i64, i64)>)> {
        let mut found = Vec::new();
        length(bytes, |id, value| found.push((id, value))).map(|it| (it, found))
    }

    #[test]
    fn a_structure_ends_where_it_ends_and_its_numbers_are_known() {
        // 1: i32 = 0; 2: i32 = 300; 3: true; 5: binary "ab"; 6: a list of two i32; 40: a structure; the end.
        let bytes = [
            0x15, 0x00, 0x15, 0xd8, 0x04, 0x11, 0x28, 0x02, b'a', b'b', 0x19, 0x25, 0x02, 0x04, 0x0c, 0x50,
            0x16, 0x03, 0x00, 0x00,
        ];
        let expected = Some((bytes.len(), vec![(1, 0), (2, 300)]));
        assert_eq!(numbers(&bytes), expected);
        assert_eq!(numbers(&[&bytes[..], &[7, 7]].concat()), expected);
        for end in 0..bytes.len() {
            assert_eq!(numbers(&bytes[..end]), None, "cut after {end} bytes");
        }
    }

    #[test]
    fn lists_of_more_elements_than_bytes_and_deep_structures_are_none() {
        // A list of 2³⁰ times true.
        assert_eq!(numbers(&[0x19, 0xf1, 0x80, 0x80, 0x80, 0x80, 0x04, 0x01, 0x01, 0x00]), None);
        assert_eq!(numbers(&[0x18, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x01, 0x00]), None);
        assert_eq!(numbers(&[0x1c; 4000]), None);
        assert_eq!(numbers(&[0xff; 40]), None);
    }
}
