// Ticks are exactly a period apart, for every period of 24 bits, and a stopped clock is silent.

module step_clock_proof(input clock, input clear, input [23:0] period);
    wire tick;
    step_clock dut(.clock(clock), .clear(clear), .period(period), .tick(tick));

    (* hierconn *) wire [23:0] \dut.left_q ;
    // Clocks since the period began, and how long it was then.
    reg [23:0] since, length;
    reg known = 0;
    always @(posedge clock) begin
        if (clear) known <= 1;
        if (clear || tick || length == 0) begin
            since <= 1;
            length <= period;
        end else since <= since + 1;
    end

    always @* if (known) begin
        assert (length == 0 || since <= length);
        assert ( \dut.left_q == (length == 0 ? 0 : length - since + 1));
        assert (tick == (length != 0 && since == length));
    end

    always @* cover (known && tick && length == 3);
    always @* cover (known && tick && length == 1);
endmodule
