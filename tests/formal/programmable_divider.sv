// One pulse for every N, for every N from 1 to 999, whatever pulses come; half marks N/2.

module programmable_divider_proof(
    input clock, input clear, input pulse,
    input [3:0] hundreds, input [3:0] tens, input [3:0] units
);
    wire divided, half;
    programmable_divider dut(.clock(clock), .clear(clear), .pulse(pulse),
        .preset({hundreds, tens, units}), .divided(divided), .half(half));

    (* hierconn *) wire [3:0] \dut.hundreds.state_q ;
    (* hierconn *) wire [3:0] \dut.tens.state_q ;
    (* hierconn *) wire [3:0] \dut.units.state_q ;
    wire [9:0] shown = 100 * \dut.hundreds.state_q + 10 * \dut.tens.state_q + \dut.units.state_q ;
    wire [9:0] n = 100 * hundreds + 10 * tens + units;

    // The wheels show decimals, not 000, and are turned only while the divider is cleared.
    reg [11:0] wheels;
    reg known = 0;
    always @* begin
        assume (hundreds <= 9 && tens <= 9 && units <= 9 && n != 0);
        if (known && !clear) assume (wheels == {hundreds, tens, units});
    end

    // Pulses since the last output pulse, counted in binary.
    reg [9:0] counted;
    always @(posedge clock) begin
        wheels <= {hundreds, tens, units};
        if (clear) known <= 1;
        if (clear) counted <= 0;
        else if (divided) counted <= pulse;
        else counted <= counted + pulse;
    end

    always @* if (known) begin
        assert (\dut.hundreds.state_q <= 9 && \dut.tens.state_q <= 9 && \dut.units.state_q <= 9);
        assert (shown == counted);
        if (!clear) begin
            assert (counted <= n);
            assert (divided == (counted == n));
            assert (half == (counted == n / 2));
        end
    end

    always @* cover (known && divided && pulse && n == 3);
    always @* cover (known && half && n == 6);
endmodule
