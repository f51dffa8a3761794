//! Frames: the vehicles in a view as bytes. The layout is in the reference of the viewer's protocol.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};
use std::f64::consts::TAU;

use laneweave::Side;

use crate::snapshot::{Colour, Seen, Snapshot};

/// First bytes of a frame, with the version of its layout.
const MAGIC: [u8; 4] = *b"LWF\x01";
/// Bytes of the header.
const HEADER: usize = 48;
/// Bytes of a record.
const RECORD: usize = 16;
/// Heights are counted from here [m], in steps of [`HEIGHT_STEP`].
const LOWEST: f64 = -1638.4;
const HEIGHT_STEP: f64 = 0.05;
/// Speeds are counted in steps of this [m/s].
const SPEED_STEP: f64 = 0.25;
/// The style of drivers beyond it is not told apart.
const LAST_STYLE: u8 = 63;

/// A part of the map: west, south, east, north [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View(pub [f64; 4]);

impl View {
    /// All of the map.
    pub const ALL: View = View([f64::NEG_INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::INFINITY]);

    fn shows(&self, it: &Seen) -> bool {
        let View([west, south, east, north]) = *self;
        // A vehicle whose centre is outside may reach into the view.
        let reach = it.length;
        let [x, y, _] = it.at;
        x > west - reach && x < east + reach && y > south - reach && y < north + reach
    }
}

/// The slots of one connection: a vehicle has the same one from frame to frame, for as long as it is in view.
#[derive(Clone, Debug, Default)]
pub struct Slots {
    by_id: HashMap<i64, u32>,
    /// The vehicle in each slot, and the number of the frame in which it was there.
    held: Vec<Option<(i64, u32)>>,
    /// Empty slots, the first one first.
    free: BinaryHeap<Reverse<u32>>,
    /// Number of the last frame.
    frame: u32,
}

impl Slots {
    /// The frame of `snapshot` for a page with this view and colour.
    pub fn frame(&mut self, snapshot: &Snapshot, origin: [f64; 3], view: View, colour: Colour) -> Vec<u8> {
        self.frame = self.frame.wrapping_add(1);
        let seen: Vec<&Seen> = snapshot.vehicles.iter().filter(|it| view.shows(it)).collect();
        let mut entered = Vec::new();
        let slots: Vec<u32> = seen.iter().map(|it| self.slot(it, &mut entered)).collect();
        let count = self.held.len();
        let mut bytes = vec![0; HEADER + RECORD * count];
        bytes[..4].copy_from_slice(&MAGIC);
        bytes[4..8].copy_from_slice(&snapshot.number.to_le_bytes());
        bytes[8..16].copy_from_slice(&snapshot.time_s.to_le_bytes());
        for (place, value) in bytes[16..40].chunks_exact_mut(8).zip(origin) {
            place.copy_from_slice(&value.to_le_bytes());
        }
        bytes[40..44].copy_from_slice(&(count as u32).to_le_bytes());
        bytes[44..48].copy_from_slice(&((entered.len() / RECORD) as u32).to_le_bytes());
        for (slot, it) in slots.into_iter().zip(seen) {
            let from = HEADER + RECORD * slot as usize;
            bytes[from..from + RECORD].copy_from_slice(&record(it, origin, colour.of(it)));
        }
        bytes.extend_from_slice(&entered);
        self.let_go();
        bytes
    }

    /// The slot of a vehicle. If it has just come, it gets one, and a record of its own.
    fn slot(&mut self, it: &Seen, entered: &mut Vec<u8>) -> u32 {
        let slot = *self.by_id.entry(it.id).or_insert_with(|| {
            let slot = self.free.pop().map_or(self.held.len() as u32, |Reverse(slot)| slot);
            if slot as usize == self.held.len() {
                self.held.push(None);
            }
            entered.extend_from_slice(&slot.to_le_bytes());
            entered.extend_from_slice(&it.id.to_le_bytes());
            let centimetres = |metres: f64| (metres * 100.0).round() as u16;
            entered.extend_from_slice(&centimetres(it.length).to_le_bytes());
            entered.extend_from_slice(&centimetres(it.width).to_le_bytes());
            slot
        });
        self.held[slot as usize] = Some((it.id, self.frame));
        slot
    }

    /// Empties the slots of vehicles that were not in this frame: none of them was used again in it.
    fn let_go(&mut self) {
        for (slot, held) in self.held.iter_mut().enumerate() {
            if let Some((id, frame)) = *held
                && frame != self.frame
            {
                self.by_id.remove(&id);
                *held = None;
                self.free.push(Reverse(slot as u32));
            }
        }
        let used = self.held.iter().rposition(Option::is_some).map_or(0, |it| it + 1);
        if used < self.held.len() {
            self.held.truncate(used);
            self.free.retain(|Reverse(slot)| (*slot as usize) < used);
        }
    }
}

/// The record of a vehicle in its slot.
fn record(it: &Seen, origin: [f64; 3], value: u8) -> [u8; RECORD] {
    let [x, y, z] = [0, 1, 2].map(|axis| it.at[axis] - origin[axis]);
    let heading = (it.heading.rem_euclid(TAU) / TAU * 65536.0).round() as u32 as u16;
    let height = ((z - LOWEST) / HEIGHT_STEP).round() as u16;
    let flag = |is_set: bool, bit: u8| u8::from(is_set) << bit;
    let flags = it.body as u8
        | flag(it.is_braking, 3)
        | flag(it.signals == Some(Side::Left), 4)
        | flag(it.signals == Some(Side::Right), 5)
        | flag(it.is_external, 6)
        | flag(it.is_recorded, 7);
    let mut bytes = [0; RECORD];
    bytes[..4].copy_from_slice(&(x as f32).to_le_bytes());
    bytes[4..8].copy_from_slice(&(y as f32).to_le_bytes());
    bytes[8..10].copy_from_slice(&heading.to_le_bytes());
    bytes[10..12].copy_from_slice(&height.to_le_bytes());
    bytes[12] = (it.speed / SPEED_STEP).round() as u8;
    bytes[13] = it.style.min(LAST_STYLE) | (it.phase << 6);
    bytes[14] = flags;
    bytes[15] = value;
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::snapshot::Body;

    fn car(id: i64, x: f64) -> Seen {
        Seen {
            id,
            at: [x, 20.0, 1.0],
            heading: -TAU / 4.0,
            speed: 10.1,
            length: 4.5,
            width: 1.8,
            body: Body::Car,
            style: 2,
            phase: 1,
            is_braking: true,
            signals: Some(Side::Left),
            is_external: false,
            is_recorded: false,
            values: [200, 0, 255, 0],
        }
    }

    fn of(vehicles: Vec<Seen>) -> Snapshot {
        Snapshot { number: 7, time_s: 12.5, vehicles, ..Snapshot::default() }
    }

    fn word(bytes: &[u8], at: usize) -> u32 {
        u32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]])
    }

    #[test]
    fn a_frame_has_the_bytes_of_the_reference() {
        let bytes =
            Slots::default().frame(&of(vec![car(-5, 103.5)]), [100.0, 0.0, 0.0], View::ALL, Colour::Desire);
        assert_eq!(bytes.len(), 48 + 16 + 16);
        assert_eq!(&bytes[..4], b"LWF\x01");
        assert_eq!([word(&bytes, 4), word(&bytes, 40), word(&bytes, 44)], [7, 1, 1]);
        assert_eq!(bytes[8..16], 12.5f64.to_le_bytes());
        assert_eq!(bytes[16..24], 100.0f64.to_le_bytes());
        assert_eq!(bytes[48..52], 3.5f32.to_le_bytes());
        assert_eq!(bytes[52..56], 20.0f32.to_le_bytes());
        // Three quarters of a turn; 1 m above −1638.4 m; 10 m/s; style 2, wants; a car that brakes and signals left.
        assert_eq!(bytes[56..58], 49152u16.to_le_bytes());
        assert_eq!(bytes[58..60], 32788u16.to_le_bytes());
        assert_eq!(bytes[60..64], [40, 2 | 1 << 6, 1 | 1 << 3 | 1 << 4, 200]);
        assert_eq!(bytes[64..68], 0u32.to_le_bytes());
        assert_eq!(bytes[68..76], (-5i64).to_le_bytes());
        assert_eq!(bytes[76..80], [0xc2, 0x01, 0xb4, 0x00]);
    }

    #[test]
    fn a_vehicle_keeps_its_slot_and_an_empty_one_is_seen_before_it_is_used_again() {
        let mut slots = Slots::default();
        let mut frame = |cars: Vec<Seen>| {
            let bytes = slots.frame(&of(cars), [0.0; 3], View::ALL, Colour::Style);
            let count = word(&bytes, 40) as usize;
            let xs = (0..count).map(|it| f32::from_bits(word(&bytes, 48 + 16 * it))).collect::<Vec<f32>>();
            (xs, word(&bytes, 44))
        };
        assert_eq!(frame(vec![car(1, 10.0), car(2, 20.0), car(3, 30.0)]), (vec![10.0, 20.0, 30.0], 3));
        // The second one leaves: its slot is empty for a frame. Then another vehicle has it.
        assert_eq!(frame(vec![car(1, 11.0), car(3, 31.0), car(4, 40.0)]), (vec![11.0, 0.0, 31.0, 40.0], 1));
        assert_eq!(frame(vec![car(5, 50.0), car(4, 41.0), car(3, 32.0)]), (vec![0.0, 50.0, 32.0, 41.0], 1));
        // No slots are kept behind the last vehicle.
        assert_eq!(frame(vec![car(5, 51.0)]), (vec![0.0, 51.0, 0.0, 0.0], 0));
        assert_eq!(frame(vec![car(5, 52.0)]), (vec![0.0, 52.0], 0));
    }

    #[test]
    fn only_what_is_in_view_is_sent() {
        let view = View([0.0, 0.0, 100.0, 100.0]);
        let cars = vec![car(1, 50.0), car(2, 104.0), car(3, 105.0)];
        let bytes = Slots::default().frame(&of(cars), [0.0; 3], view, Colour::Style);
        // The second one reaches into the view with its length of 4.5 m.
        assert_eq!(word(&bytes, 40), 2);
    }
}
