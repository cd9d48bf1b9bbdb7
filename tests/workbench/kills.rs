//! A kill, whatever the moment, loses nothing that was shown as saved.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Child, Command};
use std::time::Duration;

use tempfile::TempDir;

use super::{Server, example, json, with_data};
use crate::support::command::{put, scratch};

/// Whatever the moment, the file is whole, and not older than what was acknowledged.
#[test]
fn a_kill_loses_nothing_that_was_shown_as_saved() {
    let bench = example("hidden-gear");
    let path = bench.path().join("machine.toml");
    let machine = std::fs::read_to_string(&path).unwrap();
    let numbered = |number: u32| machine.replacen("title = ", &format!("# {number}\ntitle = "), 1);
    let number_in = |text: &str| -> u32 {
        text.strip_prefix("# ").and_then(|rest| rest.lines().next()?.parse().ok()).unwrap_or(0)
    };
    let mut number = 0;
    for wait_ms in [3, 7, 12, 18, 25, 40] {
        let mut server = Server::over(bench.path());
        let mut child = std::mem::replace(&mut server.child, idle());
        let killer = std::thread::spawn(move || {
            std::thread::sleep(Duration::from_millis(10 * wait_ms));
            child.kill().and_then(|()| child.wait())
        });
        let mut acknowledged = number;
        let mut revision = server.revision();
        while server.save(&revision, &numbered(number + 1)) == Some(200) {
            number += 1;
            acknowledged = number;
            let state = server.ask("GET", "state?machine=machine.toml", "");
            let Some((200, state)) = state else { break };
            revision = json(&state)["revision"].as_str().expect("a revision").to_owned();
        }
        killer.join().expect("no panic").expect("the server is killed");
        let text = std::fs::read_to_string(&path).unwrap();
        let found = number_in(&text);
        assert!(acknowledged <= found && found <= acknowledged + 1, "{found}, {acknowledged}");
        assert!(found == 0 || text == numbered(found), "the file is whole");
        number = found;
    }
}

/// A process that does nothing, in the place of one that is killed elsewhere.
fn idle() -> Child {
    Command::new("sleep").arg("60").spawn().expect("`sleep` starts")
}

/// Something that a page writes: what it is, and how a page comes to ask for it.
struct Deed {
    name: &'static str,
    /// What is asked, and with which body.
    asked: fn(&Server) -> (String, String),
    /// How many files get their names on the way there.
    before: usize,
}

const REFUSAL: Deed = Deed {
    name: "a refusal",
    asked: |server| {
        let body = serde_json::json!({ "effect": "backlash", "reason": "it was measured" });
        (server.change("refuse"), body.to_string())
    },
    before: 0,
};

/// The fit runs beside the server and gives one file its name.
const ADDITION: Deed = Deed {
    name: "an effect",
    asked: |server| {
        let job = server.finished("&command=add&effect=gear-error");
        (server.change("take") + &format!("&job={}", job["job"]), "{}".into())
    },
    before: 1,
};

const UNDO: Deed =
    Deed { name: "an undo", asked: |server| (server.change("undo"), "{}".into()), before: 0 };

const RECIPE: Deed = Deed {
    name: "a reading",
    asked: |server| {
        let reading = server.answered(
            "POST",
            "drop?name=dial.txt",
            "position_mm;error_um\n1,0;0,5\n2,0;0,25\n3,0;0,5\n",
        );
        let file = serde_json::json!({ "file": reading["file"], "recipes": [] });
        (server.change("save"), file.to_string())
    },
    before: 0,
};

/// Killed at each system call that gives a file its name or takes one away, the server leaves the
/// files as they were or, to whoever opens the folder again, as they were to be; and so whenever it
/// said that they are saved.
#[test]
#[cfg(target_os = "linux")]
fn a_kill_leaves_a_change_done_or_not_begun() {
    let bench = with_data("6");
    let learned = copy(bench.path());
    assert_eq!(done(learned.path(), &ADDITION), Some(200));
    let deeds = [(&bench, REFUSAL), (&bench, ADDITION), (&learned, UNDO), (&bench, RECIPE)];
    for (from, deed) in deeds {
        let whole = copy(from.path());
        assert_eq!(done(whole.path(), &deed), Some(200), "{}", deed.name);
        let (before, after) = (files(from.path()), files(whole.path()));
        assert!(before != after, "{}", deed.name);
        let mut found = [0, 0];
        for (call, first) in [("linkat", deed.before), ("rename", deed.before), ("unlink", 0)] {
            for time in first + 1.. {
                let folder = copy(from.path());
                let saved = killed(folder.path(), &deed, (call, time)) == Some(200);
                let _ = Server::over(folder.path()).revision();
                let left = files(folder.path());
                let place = format!("{}, {call} {time}: {:?}", deed.name, left.keys());
                assert!(left == before || left == after, "a mixture: {place}");
                assert!(left == after || !saved, "what was saved is lost: {place}");
                if saved {
                    break;
                }
                found[usize::from(left == after)] += 1;
            }
        }
        assert!(found.iter().all(|count| 0 < *count), "{}: {found:?}", deed.name);
    }
}

/// Does it; the status.
fn done(folder: &Path, deed: &Deed) -> Option<u16> {
    let server = Server::over(folder);
    let (what, body) = (deed.asked)(&server);
    server.ask("POST", &what, &body).map(|(status, _)| status)
}

/// Does it in a server that is killed when one of its threads makes such a call for the n-th time;
/// the status, if there was time for one.
fn killed(folder: &Path, deed: &Deed, (call, time): (&str, usize)) -> Option<u16> {
    let mut command = Command::new("strace");
    command.args(["-f", "-qq", "-o", "/dev/null", "-e", &format!("trace={call}"), "-e"]);
    command.arg(format!("inject={call}:signal=KILL:when={time}"));
    command.arg(env!("CARGO_BIN_EXE_helixlock"));
    let server = Server::run(command, folder);
    let (what, body) = (deed.asked)(&server);
    let status = server.ask("POST", &what, &body).map(|(status, _)| status);
    if status.is_some() {
        let strace = server.child.id();
        let children = std::fs::read_to_string(format!("/proc/{strace}/task/{strace}/children"));
        let child = children.expect("Linux says").trim().to_owned();
        let ended = Command::new("kill").args(["-KILL", &child]).status();
        assert!(ended.expect("`kill` starts").success());
    }
    status
}

/// All files below a folder, those with hidden names too.
fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in std::fs::read_dir(&next).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let name = path.strip_prefix(folder).expect("it is below").to_owned();
                found.insert(name, std::fs::read(&path).expect("a file"));
            }
        }
    }
    found
}

/// The same files in another folder.
fn copy(folder: &Path) -> TempDir {
    let other = scratch();
    for (name, content) in files(folder) {
        put(&other.path().join(name), std::str::from_utf8(&content).expect("text"));
    }
    other
}
