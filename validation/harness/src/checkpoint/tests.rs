use super::*;

fn keep(checkpoints: &Checkpoints, contents: &str) -> bool {
    checkpoints.keep(|| Ok(contents.as_bytes().to_vec()))
}

fn text(contents: &[u8]) -> Result<String, String> {
    String::from_utf8(contents.to_vec()).map_err(|error| error.to_string())
}

/// Contents that a program starting now would continue from.
fn left(folder: &Path, key: &str) -> Option<String> {
    Checkpoints::at(folder, key, None).take(text)
}

#[test]
fn the_last_two_are_kept_and_the_newest_is_continued_once() {
    let root = tempfile::tempdir().expect("temporary folder");
    let folder = root.path().join("run");
    assert_eq!(left(&folder, "a"), None);
    let writing = Checkpoints::at(&folder, "a", None);
    for contents in ["one", "two", "three"] {
        assert!(keep(&writing, contents));
    }
    assert_eq!(writing.numbers(), [1, 2]);
    let reading = Checkpoints::at(&folder, "a", None);
    assert_eq!(reading.look(text).as_deref(), Some("three"));
    assert_eq!(reading.take(text).as_deref(), Some("three"));
    assert_eq!(reading.take(text), None);
    reading.discard();
    assert!(!folder.exists());
}

#[test]
fn damaged_checkpoint_gives_way_to_the_previous_one() {
    let root = tempfile::tempdir().expect("temporary folder");
    let folder = root.path().join("run");
    let writing = Checkpoints::at(&folder, "a", None);
    assert!(keep(&writing, "one") && keep(&writing, "two"));
    let newest = writing.path(1);
    let whole = std::fs::read(&newest).expect("written");
    assert_eq!(left(&folder, "b"), None, "that of another run");
    let refused = |bytes: &[u8]| {
        std::fs::write(&newest, bytes).expect("writable");
        assert_eq!(left(&folder, "a").as_deref(), Some("one"));
        STATE.read(&newest, Some("a")).expect_err("refused").to_string()
    };
    assert_eq!(refused(&whole[..whole.len() - 1]), "is damaged");
    assert_eq!(refused(&whole[..10]), "is damaged");
    assert_eq!(refused(&[]), "is damaged");
    let changed = |place: usize| {
        let mut bytes = whole.clone();
        bytes[place] ^= 1;
        bytes
    };
    assert_eq!(refused(&changed(whole.len() - 1)), "is damaged");
    assert_eq!(refused(&changed(0)), "is not a bagnold checkpoint");
    assert_eq!(refused(&changed(19)), "has format 0, but this program reads format 1");
    assert_eq!(refused(&changed(31)), "belongs to another run, or to another version of the program");
    std::fs::remove_file(&newest).expect("removable");
    std::fs::create_dir(&newest).expect("writable");
    assert_eq!(left(&folder, "a").as_deref(), Some("one"));
    assert_eq!(STATE.read(&newest, Some("a")).expect_err("refused").to_string(), "cannot be read (is a directory)");
}

#[test]
fn a_state_that_the_run_refuses_gives_way_to_the_one_before() {
    let root = tempfile::tempdir().expect("temporary folder");
    let writing = Checkpoints::at(root.path(), "a", None);
    assert!(keep(&writing, "one") && keep(&writing, "two"));
    let reading = Checkpoints::at(root.path(), "a", None);
    let only_one = |contents: &[u8]| if contents == b"one" { Ok(1) } else { Err("another scene".to_owned()) };
    assert_eq!(reading.look(only_one), Some(1));
    assert_eq!(reading.take(text).as_deref(), Some("one"), "what was looked at is what is taken");
}

#[test]
fn a_checkpoint_that_cannot_be_written_leaves_those_before_it() {
    let root = tempfile::tempdir().expect("temporary folder");
    let folder = root.path().join("run");
    let writing = Checkpoints::at(&folder, "a", None);
    assert!(keep(&writing, "one"));
    // no rename replaces a folder that is not empty
    std::fs::create_dir_all(writing.path(1).join("x")).expect("writable");
    assert!(STATE.write(&writing.path(1), "a", b"two").is_err());
    assert_eq!(left(&folder, "a").as_deref(), Some("one"));
    assert_eq!(std::fs::read_dir(&folder).expect("readable").count(), 2, "nothing half written stays");
    let file = root.path().join("file");
    std::fs::write(&file, "").expect("writable");
    assert!(!keep(&Checkpoints::at(&file.join("run"), "a", None), "three"), "below a file nobody makes a folder");
    assert_eq!(left(&folder, "a").as_deref(), Some("one"));
}

#[test]
fn the_next_one_is_due_after_the_interval_that_was_asked_for() {
    let root = tempfile::tempdir().expect("temporary folder");
    assert!(!Checkpoints::at(root.path(), "a", None).is_due());
    let eager = Checkpoints::at(root.path(), "a", Some(Duration::ZERO));
    assert!(eager.is_due() && keep(&eager, "one") && eager.is_due());
    assert!(!Checkpoints::at(root.path(), "a", Some(Duration::from_secs(3600))).is_due());
}
