//! Names that Verilog readers, old and new, accept.

use helixlock_netlist::Module;

use crate::GenError;

/// Checks every name of a module.
pub(crate) fn check(module: &Module) -> Result<(), GenError> {
    let ports = module.ports.iter().map(|port| &port.name);
    let signals = module.signals.iter().map(|signal| &signal.name);
    let instances = module.instances.iter().map(|instance| &instance.name);
    for name in ports.chain(signals).chain(instances).chain([&module.name]) {
        if let Some(found) = fault(name) {
            return Err(GenError::Name { module: module.name.clone(), name: name.clone(), found });
        }
    }
    Ok(())
}

fn fault(name: &str) -> Option<&'static str> {
    let legal = |c: char| c.is_ascii_alphanumeric() || c == '_';
    if !name.chars().all(legal) || !name.starts_with(|c: char| c.is_ascii_alphabetic()) {
        return Some("no identifier");
    }
    if name == UNUSED {
        return Some("kept for signals without a reader");
    }
    KEYWORDS.split_ascii_whitespace().any(|word| word == name).then_some("a reserved word")
}

/// The wire that gathers signals without a reader; linters know names of this sort.
pub(crate) const UNUSED: &str = "unused_bits";

/// IEEE 1800-2017, annex B, which contains all of IEEE 1364-2005.
const KEYWORDS: &str = "
    accept_on alias always always_comb always_ff always_latch and assert assign assume automatic
    before begin bind bins binsof bit break buf bufif0 bufif1 byte case casex casez cell chandle
    checker class clocking cmos config const constraint context continue cover covergroup
    coverpoint cross deassign default defparam design disable dist do edge else end endcase
    endchecker endclass endclocking endconfig endfunction endgenerate endgroup endinterface
    endmodule endpackage endprimitive endprogram endproperty endsequence endspecify endtable
    endtask enum event eventually expect export extends extern final first_match for force foreach
    forever fork forkjoin function generate genvar global highz0 highz1 if iff ifnone ignore_bins
    illegal_bins implements implies import incdir include initial inout input inside instance int
    integer interconnect interface intersect join join_any join_none large let liblist library
    local localparam logic longint macromodule matches medium modport module nand negedge nettype
    new nexttime nmos nor noshowcancelled not notif0 notif1 null or output package packed
    parameter pmos posedge primitive priority program property protected pull0 pull1 pulldown
    pullup pulsestyle_ondetect pulsestyle_onevent pure rand randc randcase randsequence rcmos real
    realtime ref reg reject_on release repeat restrict return rnmos rpmos rtran rtranif0 rtranif1
    s_always s_eventually s_nexttime s_until s_until_with scalared sequence shortint shortreal
    showcancelled signed small soft solve specify specparam static string strong strong0 strong1
    struct super supply0 supply1 sync_accept_on sync_reject_on table tagged task this throughout
    time timeprecision timeunit tran tranif0 tranif1 tri tri0 tri1 triand trior trireg type typedef
    union unique unique0 unsigned until until_with untyped use uwire var vectored virtual void wait
    wait_order wand weak weak0 weak1 while wildcard wire with within wor xnor xor
";
