//! What to do about packages that are missing.

use super::{FOLDER, Kind, Package};

/// What may be done about Debian packages on this machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rights {
    /// We are root.
    Root,
    /// There is `sudo`.
    Sudo,
    /// Neither.
    None,
    /// There is no `apt-get`.
    NotDebian,
}

/// What to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Plan {
    /// Nothing: all is there.
    Ready,
    /// To run these commands, in order; each is its words.
    Install(Vec<Vec<String>>),
    /// To stop with this message.
    Refuse(String),
}

/// What to do about packages that are missing, if they may be installed.
#[must_use]
pub fn plan(missing: &[&Package], rights: Rights, install: bool) -> Plan {
    if missing.is_empty() {
        return Plan::Ready;
    }
    let commands = commands(missing, rights);
    let debian = missing.iter().any(|package| package.kind == Kind::Debian);
    match rights {
        Rights::NotDebian if debian => refuse(missing, ", and no apt-get to install it", &[]),
        Rights::None if debian && install => {
            refuse(missing, ", and neither root nor sudo to install it", &commands)
        }
        _ if install => Plan::Install(commands),
        _ => refuse(missing, "", &commands),
    }
}

/// Says what is missing, why it stays so, and what would install it.
fn refuse(missing: &[&Package], why: &str, commands: &[Vec<String>]) -> Plan {
    let names: Vec<_> = missing.iter().map(|package| format!("`{}`", package.name)).collect();
    let lines = commands.iter().map(|words| format!("\n  {}", words.join(" ")));
    Plan::Refuse(format!("{} not found{why}{}", names.join(", "), lines.collect::<String>()))
}

fn names<'a>(missing: &[&'a Package], kind: Kind) -> Vec<&'a str> {
    let of_kind = missing.iter().filter(|package| package.kind == kind);
    of_kind.map(|package| package.name).collect()
}

fn commands(missing: &[&Package], rights: Rights) -> Vec<Vec<String>> {
    let sudo = if rights == Rights::Sudo { "sudo " } else { "" };
    let python = format!("{FOLDER}/python");
    let installers = [
        (Kind::Debian, format!("{sudo}apt-get update --quiet")),
        (Kind::Debian, format!("{sudo}apt-get install --yes --no-install-recommends NAMES")),
        (Kind::Pypi, format!("python3 -m venv {python}")),
        (Kind::Pypi, format!("{python}/bin/pip install --quiet NAMES")),
        (Kind::Npm, format!("npm install --prefix {FOLDER}/node --no-audit --no-fund NAMES")),
    ];
    let wanted = installers.iter().filter(|(kind, _)| !names(missing, *kind).is_empty());
    let words = |(kind, command): &(Kind, String)| words(command, &names(missing, *kind));
    wanted.map(words).collect()
}

/// A command's words, the names of packages in the place of `NAMES`.
fn words(command: &str, names: &[&str]) -> Vec<String> {
    let word = |word| if word == "NAMES" { names.to_vec() } else { vec![word] };
    command.split(' ').flat_map(word).map(str::to_owned).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const YOSYS: Package = package(Kind::Debian, "yosys");
    const MAKE: Package = package(Kind::Debian, "make");
    const NUMPY: Package = package(Kind::Pypi, "numpy==2.4.6");
    const JSDOM: Package = package(Kind::Npm, "jsdom@26.1.0");

    const fn package(kind: Kind, name: &'static str) -> Package {
        Package { kind, name, signs: &[] }
    }

    /// The plan, its commands as lines.
    fn lines(missing: &[&Package], rights: Rights) -> Vec<String> {
        match plan(missing, rights, true) {
            Plan::Install(commands) => commands.iter().map(|words| words.join(" ")).collect(),
            other => panic!("{other:?}"),
        }
    }

    fn message(missing: &[&Package], rights: Rights, install: bool) -> String {
        match plan(missing, rights, install) {
            Plan::Refuse(message) => message,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn nothing_is_done_when_nothing_is_missing() {
        for install in [false, true] {
            assert_eq!(plan(&[], Rights::NotDebian, install), Plan::Ready);
        }
    }

    #[test]
    fn root_installs_only_what_is_missing() {
        let expected =
            ["apt-get update --quiet", "apt-get install --yes --no-install-recommends yosys make"];
        assert_eq!(lines(&[&YOSYS, &MAKE], Rights::Root), expected);
    }

    #[test]
    fn others_install_debian_packages_with_sudo() {
        let lines = lines(&[&MAKE], Rights::Sudo);
        assert!(lines.iter().all(|line| line.starts_with("sudo apt-get ")), "{lines:?}");
    }

    /// They lie in folders of the project's own, for which nobody has to be root.
    #[test]
    fn packages_of_other_kinds_need_no_rights() {
        let expected = [
            "python3 -m venv target/tools/python",
            "target/tools/python/bin/pip install --quiet numpy==2.4.6",
            "npm install --prefix target/tools/node --no-audit --no-fund jsdom@26.1.0",
        ];
        for rights in [Rights::Root, Rights::Sudo, Rights::None, Rights::NotDebian] {
            assert_eq!(lines(&[&JSDOM, &NUMPY], rights), expected);
        }
    }

    #[test]
    fn without_leave_to_install_it_says_what_is_missing_and_what_would_install_it() {
        let expected = "`yosys`, `make` not found\n  sudo apt-get update --quiet\n  \
                        sudo apt-get install --yes --no-install-recommends yosys make";
        assert_eq!(message(&[&YOSYS, &MAKE], Rights::Sudo, false), expected);
    }

    #[test]
    fn without_rights_it_says_so() {
        let found = message(&[&MAKE, &NUMPY], Rights::None, true);
        let expected = "`make`, `numpy==2.4.6` not found, and neither root nor sudo to install it";
        assert_eq!(found.lines().next(), Some(expected));
        let found = message(&[&MAKE], Rights::NotDebian, true);
        assert_eq!(found, "`make` not found, and no apt-get to install it");
    }
}
