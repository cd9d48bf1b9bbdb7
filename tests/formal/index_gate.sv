// Without an index the switch passes; with one a pass is open from the first rise of the index on,
// until the switch is off.

module index_gate_proof(input clock, input wired, input start, input started, input index);
    wire open;
    index_gate dut(.clock(clock), .wired(wired), .start(start), .started(started), .index(index),
        .open(open));
    (* hierconn *) wire \dut.before_q ;
    (* hierconn *) wire \dut.passed_q ;

    reg old = 0;
    reg known = 0;
    reg was_index, seen;
    always @(posedge clock) begin
        old <= 1;
        was_index <= index;
        if (!started) begin
            known <= 1;
            seen <= 0;
        end else if (index && !was_index) seen <= 1;
    end

    always @* if (old) assert (\dut.before_q == was_index);
    always @* if (known) assert (\dut.passed_q == seen);
    always @* if (!wired) assert (open == start);
    always @* if (wired && !started) assert (!open);
    always @* if (wired && known && started) assert (open == seen);

    always @* cover (wired && known && open && !index);
endmodule
