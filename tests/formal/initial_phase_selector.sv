// The gate opens after exactly m laser pulses, for every m from 0 to 999, and lets lines through
// only then.

module initial_phase_selector_proof(
    input clock, input clear, input laser, input grating,
    input [3:0] hundreds, input [3:0] tens, input [3:0] units
);
    wire open, line;
    initial_phase_selector dut(.clock(clock), .clear(clear), .laser(laser), .grating(grating),
        .preset({hundreds, tens, units}), .open(open), .line(line));

    (* hierconn *) wire [3:0] \dut.hundreds.state_q ;
    (* hierconn *) wire [3:0] \dut.tens.state_q ;
    (* hierconn *) wire [3:0] \dut.units.state_q ;
    wire [9:0] shown = 100 * \dut.hundreds.state_q + 10 * \dut.tens.state_q + \dut.units.state_q ;
    wire [9:0] m = 100 * hundreds + 10 * tens + units;

    reg [11:0] wheels;
    reg known = 0;
    always @* begin
        assume (hundreds <= 9 && tens <= 9 && units <= 9);
        if (known && !clear) assume (wheels == {hundreds, tens, units});
    end

    // Laser pulses since the clear, as far as m.
    reg [9:0] counted;
    reg all_there;
    always @(posedge clock) begin
        wheels <= {hundreds, tens, units};
        if (clear) known <= 1;
        if (clear) counted <= 0;
        else if (counted < m) counted <= counted + laser;
        all_there <= !clear && counted == m;
    end

    always @* assert (line == (open && grating));
    always @* if (known && !clear) begin
        assert (\dut.hundreds.state_q <= 9 && \dut.tens.state_q <= 9 && \dut.units.state_q <= 9);
        assert (counted <= m);
        assert (shown == counted);
        assert (open == all_there);
        if (open) assert (counted == m);
    end

    always @* cover (known && open && m == 3);
endmodule
