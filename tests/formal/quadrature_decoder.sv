// Pulses are the lines further forward than ever since clear: none is lost by going back, none is
// counted twice.

module quadrature_decoder_proof(input clock, input clear, input a, input b);
    wire pulse, lost;
    wire [15:0] behind;
    quadrature_decoder dut(.clock(clock), .clear(clear), .a(a), .b(b), .pulse(pulse),
        .behind(behind), .lost(lost));
    (* hierconn *) wire \dut.before_q ;

    // Where the encoder is, in lines since clear, the furthest it was, and the pulses that came.
    reg [1:0] age = 0;
    reg cleared = 0;
    reg was_a, was_pulse, further, overrun;
    reg [31:0] position, furthest, pulses;
    wire up = a && !was_a && !b;
    wire down = !a && was_a && !b;
    wire full = furthest - position == 65535;
    always @(posedge clock) begin
        age <= (age == 2) ? age : age + 1;
        was_a <= a;
        was_pulse <= pulse;
        further <= up && (clear || position == furthest);
        if (clear) begin
            cleared <= age != 0;
            {position, furthest} <= 0;
            pulses <= -{31'd0, up};
            overrun <= 0;
        end else begin
            if (up) position <= position + 1;
            if (up && position == furthest) furthest <= furthest + 1;
            if (down && !full) position <= position - 1;
            if (down && full) overrun <= 1;
            pulses <= pulses + pulse;
        end
    end

    always @* if (age != 0) assert (\dut.before_q == was_a);
    always @* if (cleared) begin
        assert (pulse == further);
        assert ({16'd0, behind} == furthest - position);
        assert (lost == overrun);
        assert (pulses + pulse == furthest);
    end
    always @* if (age == 2 && cleared) assert (!(pulse && was_pulse));

    always @* cover (cleared && behind == 2 && furthest == 2);
    always @* cover (cleared && pulse && furthest == 2);
    always @* cover (cleared && lost);
endmodule
