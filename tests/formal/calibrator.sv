// T2 is T1 inverted; off, T1 is the meter; calibrating, high for the first 4, 2 or 3 lines of 8,
// so 225 degrees do not occur.

module calibrator_proof(
    input clock, input clear, input line, input meter, input [1:0] calibrate
);
    wire t1, t2;
    calibrator dut(.clock(clock), .clear(clear), .line(line), .meter(meter), .calibrate(calibrate),
        .t1(t1), .t2(t2));

    (* hierconn *) wire [2:0] \dut.eighth_q ;
    // Lines since the calibration was switched on, modulo 8.
    reg [2:0] lines;
    reg known = 0;
    always @(posedge clock) begin
        if (clear || calibrate == 0) known <= 1;
        if (clear || calibrate == 0) lines <= 0;
        else lines <= lines + line;
    end

    always @* assert (t2 == !t1);
    always @* if (calibrate == 0) assert (t1 == meter);
    always @* if (known) begin
        assert ( \dut.eighth_q == lines);
        if (calibrate == 1) assert (t1 == (lines < 4));
        if (calibrate == 2) assert (t1 == (lines < 2));
        if (calibrate == 3) assert (t1 == (lines < 3));
    end

    always @* cover (known && calibrate == 3 && lines == 3 && !t1);
endmodule
