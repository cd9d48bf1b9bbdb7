//! Every byte goes over the line as a serial port reads it.

use proptest::collection::vec;
use proptest::prelude::*;

use crate::properties::kept_beside_source;
use crate::support::bench::Bench;

proptest! {
    #![proptest_config(kept_beside_source())]

    /// Read back by sampling the middle of each bit; a send while busy is not heard.
    #[test]
    fn bytes_are_read_back(bytes in vec(any::<u8>(), 1..5), bit_clocks in 2_u32..20) {
        let mut bench = Bench::new("uart_transmitter");
        bench.set(&[("bit_clocks", bit_clocks.into())]);
        for byte in bytes {
            prop_assert!(bench.high("ready") && bench.high("line"));
            bench.set(&[("data", byte.into())]);
            bench.pulse(&["send"]);
            bench.set(&[("data", (!byte).into())]);
            bench.clocks(bit_clocks / 2);
            prop_assert!(!bench.high("line"), "start bit");
            let mut read = 0;
            for bit in 0..8 {
                bench.pulse(&["send"]);
                bench.clocks(bit_clocks - 1);
                read |= u8::from(bench.high("line")) << bit;
            }
            bench.clocks(bit_clocks);
            prop_assert!(bench.high("line") && !bench.high("ready"), "stop bit");
            bench.clocks(bit_clocks);
            prop_assert_eq!(read, byte);
        }
    }
}
