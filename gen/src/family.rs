//! Families of FPGAs, and what tools are told of them.

/// FPGAs of the same cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Lattice iCE40.
    Ice40,
    /// Lattice ECP5.
    Ecp5,
    /// Gowin GW1N and GW2A.
    Gowin,
}

impl Family {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Ice40, Self::Ecp5, Self::Gowin];

    /// That of a constraint file, by the file's ending.
    pub(crate) fn of(file: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|family| file.ends_with(family.constraints()))
    }

    /// Name in running text.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Ice40 => "iCE40",
            Self::Ecp5 => "ECP5",
            Self::Gowin => "Gowin",
        }
    }

    /// Command of yosys that makes gates of Verilog.
    #[must_use]
    pub fn synthesis(self) -> &'static str {
        match self {
            // Eight flip-flops of a tile share their clock enable: many small groups with one each
            // find no place on a small FPGA that has room for all cells.
            Self::Ice40 => "synth_ice40 -dffe_min_ce_use 4",
            Self::Ecp5 => "synth_ecp5",
            // No carry cells: with those of yosys 0.23 a decade wraps at 6 (mended in 2023 by pull
            // request 3745), and with later ones a GW2AR-18 counts wrongly (issue 514 of apicula).
            Self::Gowin => "synth_gowin -noalu",
        }
    }

    /// Models of the cells, as yosys finds them.
    #[must_use]
    pub fn models(self) -> &'static str {
        match self {
            Self::Ice40 => "+/ice40/cells_sim.v",
            Self::Ecp5 => "+/ecp5/cells_sim.v",
            Self::Gowin => "+/gowin/cells_sim.v",
        }
    }

    /// Beginnings of the names of look-up tables.
    #[must_use]
    pub fn tables(self) -> &'static str {
        match self {
            Self::Ice40 => "SB_LUT4",
            Self::Ecp5 => "LUT4",
            Self::Gowin => "LUT",
        }
    }

    /// Beginnings of the names of flip-flops.
    #[must_use]
    pub fn flip_flops(self) -> &'static str {
        match self {
            Self::Ice40 => "SB_DFF",
            Self::Ecp5 => "TRELLIS_FF",
            Self::Gowin => "DFF",
        }
    }

    /// Name of the carry cells.
    pub(crate) fn carries(self) -> &'static str {
        match self {
            Self::Ice40 => "SB_CARRY",
            Self::Ecp5 => "CCU2C",
            Self::Gowin => "ALU",
        }
    }

    /// Name of a logic cell in the placer's report.
    pub(crate) fn cells(self) -> &'static str {
        match self {
            Self::Ice40 => "ICESTORM_LC:",
            Self::Ecp5 => "TRELLIS_COMB:",
            Self::Gowin => "LUT4:",
        }
    }

    /// Ending of a bitstream.
    #[must_use]
    pub fn bitstream(self) -> &'static str {
        match self {
            Self::Ice40 => "bin",
            Self::Ecp5 => "bit",
            Self::Gowin => "fs",
        }
    }

    /// Ending of a constraint file.
    fn constraints(self) -> &'static str {
        match self {
            Self::Ice40 => ".pcf",
            Self::Ecp5 => ".lpf",
            Self::Gowin => ".cst",
        }
    }
}
