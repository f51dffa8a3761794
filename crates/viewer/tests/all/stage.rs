//! The thread that owns the traffic, given requests that all wait already.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::channel;

use laneweave::scenario::Origin;
use laneweave_test_data::map;
use laneweave_viewer::stage::{Request, Stage};
use laneweave_viewer::{Asked, Live, Snapshot, Source};
use serde_json::Value;
use tokio::sync::{mpsc, watch};

/// A folder of this test alone.
fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("laneweave-stage-{}-{name}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    folder
}

fn live(dir: &Path) -> Live {
    let (scenario, origin) = Origin::open(&map("ramps.osm")).expect("a map");
    Live::new(&scenario, &origin, dir.to_owned()).expect("a simulation")
}

/// Serves all requests. Returns the time at the end [s].
fn served(source: Live, requests: impl IntoIterator<Item = Request>) -> f64 {
    let (asks, asked) = channel();
    let (says_state, state) = channel();
    let all = requests.into_iter().chain([Request::State(says_state), Request::End]);
    all.for_each(|it| asks.send(it).expect("a stage"));
    let (publisher, _) = watch::channel(Arc::new(Snapshot::default()));
    Stage::new(Box::new(source), asked, publisher).run();
    state.recv().expect("a state").0
}

/// What a page is told of something.
fn told_of(key: &str, mut told: mpsc::Receiver<Arc<str>>) -> Vec<Value> {
    let texts = std::iter::from_fn(|| told.try_recv().ok());
    let messages = texts.map(|it| serde_json::from_str::<Value>(&it).expect("JSON"));
    messages.filter_map(|mut it| it.as_object_mut().expect("an object").remove(key)).collect()
}

fn asks(page: u64, text: &str) -> Request {
    Request::Asks(page, Asked::read(text).expect("a message"))
}

#[test]
fn nothing_is_done_for_pages_that_have_gone() {
    let (stays, _told) = mpsc::channel(100);
    let (leaves, _) = mpsc::channel(100);
    let mut requests = vec![Request::Comes(1, stays), Request::Comes(2, leaves)];
    requests.extend((0..1000).map(|_| asks(2, "{\"step\":100}")));
    requests.extend([Request::Goes(2), asks(2, "{\"step\":100}"), asks(1, "{\"step\":2}")]);
    let time_s = served(live(&std::env::temp_dir()), requests);
    assert!((time_s - 0.2).abs() < 1e-9, "{time_s} s");
}

#[test]
fn a_page_that_saves_without_end_fills_no_disk() {
    let dir = folder("saves");
    let (says, told) = mpsc::channel(1000);
    let mut requests = vec![Request::Comes(1, says)];
    requests.extend((0..500).map(|_| asks(1, "{\"save\":true}")));
    let begin = std::time::Instant::now();
    served(live(&dir), requests);
    let seconds = begin.elapsed().as_secs() as usize;
    let folders = std::fs::read_dir(&dir).expect("a folder").count();
    assert!(folders >= 1 && folders <= 1 + seconds, "{folders} in {seconds} s");
    let refused = told_of("refused", told);
    assert_eq!(refused.len(), 500 - folders);
    assert_eq!(refused[0]["remedy"], "save again in a second");
    let _ = std::fs::remove_dir_all(dir);
}

#[test]
fn however_much_was_done_by_hand_only_what_is_new_is_told() {
    let source = live(&std::env::temp_dir());
    let styles: Vec<String> = source.hello().styles.into_iter().map(|it| it.name).collect();
    let (says, told) = mpsc::channel(1000);
    let (late, told_late) = mpsc::channel(1000);
    let mut requests = vec![Request::Comes(1, says)];
    requests.extend((0..300).map(|number| {
        let style = &styles[number % 2];
        asks(1, &format!("{{\"hand\":{{\"set_share\":{{\"style\":\"{style}\",\"weight\":{number}}}}}}}"))
    }));
    requests.extend([asks(1, "{\"undo\":true}"), Request::Comes(2, late)]);
    served(source, requests);
    let parts = |it: &Value| ["done", "set"].map(|part| it[part].as_array().expect("a list").len());
    let all = told_of("hands", told);
    assert_eq!(parts(&all[0]), [0, 0]);
    let (undone, done) = all[1..].split_last().expect("news");
    assert_eq!(done.len(), 300);
    assert!(done.iter().all(|it| parts(it) == [1, 1]), "{}", done[299]);
    assert!(parts(undone) == [1, 1] && undone["done"][0]["is_undone"] == true, "{undone}");
    assert_eq!(undone["done"][0]["number"], 300);
    // Who comes is told of all of it.
    assert_eq!(parts(&told_of("hands", told_late)[0]), [300, 2]);
}
