/// Why a circuit cannot be run.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Gates that drive each other round and round at power-up.
    #[error("gate `{gate}` does not come to rest at power-up")]
    NeverRests {
        /// One of them.
        gate: String,
    },
    /// A name that the circuit does not have.
    #[error("circuit `{circuit}` has no `{name}`")]
    NoSuchName {
        /// The circuit.
        circuit: String,
        /// What was asked for.
        name: String,
    },
    /// A change before the present.
    #[error("a change at {time_ps} ps comes after {now_ps} ps")]
    Late {
        /// When it should have come.
        time_ps: u64,
        /// Now.
        now_ps: u64,
    },
}
