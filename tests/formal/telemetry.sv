// Clocks and high clocks of every comparison are counted, every comparison is numbered; bytes go out
// only when the transmitter is ready, a code byte is one more than the bytes behind it, and a frame
// leaves nothing behind.

module telemetry_proof(
    input clock, input clear, input measuring, input opening, input meter, input forward,
    input [11:0] count, input count_forward, input fault, input alarm, input ready
);
    wire send;
    wire [7:0] data;
    telemetry dut(.clock(clock), .clear(clear), .measuring(measuring), .opening(opening),
        .meter(meter), .forward(forward), .count(count), .count_forward(count_forward),
        .fault(fault), .alarm(alarm), .ready(ready), .send(send), .data(data));
    (* hierconn *) wire [31:0] \dut.since_q ;
    (* hierconn *) wire [31:0] \dut.high_q ;
    (* hierconn *) wire [15:0] \dut.number_q ;
    (* hierconn *) wire \dut.begun_q ;
    (* hierconn *) wire [2:0] \dut.phase_q ;
    (* hierconn *) wire [6:0] \dut.turns_q ;
    (* hierconn *) wire [3:0] \dut.run_q ;
    (* hierconn *) wire [3:0] \dut.place_q ;
    (* hierconn *) wire \dut.found_q ;
    (* hierconn *) wire \dut.at_zero_q ;
    (* hierconn *) wire [55:0] \dut.low_q ;
    (* hierconn *) wire [63:0] \dut.upper_q ;

    reg known = 0;
    reg begun;
    reg [31:0] clocks, high;
    reg [15:0] number;
    reg loaded;
    reg [31:0] period, width;
    reg [15:0] numbered, state;
    wire full = clocks[31];
    always @(posedge clock) begin
        if (clear && opening) known <= 1;
        if (clear || !measuring) begun <= 0;
        else if (opening) begun <= 1;
        clocks <= opening ? 1 : full ? clocks : clocks + 1;
        high <= opening ? meter : high + (meter && !full);
        number <= clear || !measuring ? 0 : number + (begun && opening);
        loaded <= known && !clear && \dut.phase_q == 0 && \dut.turns_q == 0 && begun && opening;
        period <= clocks;
        width <= high;
        numbered <= number;
        state <= {alarm, fault, forward, count_forward, count};
    end

    always @* if (!ready) assert (!send);
    always @* if (send && \dut.phase_q == 3) assert (data == \dut.run_q + 8'd1);
    always @* if (known) begin
        assert (\dut.begun_q == begun);
        assert (\dut.since_q == clocks);
        assert (\dut.high_q == high);
        assert (\dut.number_q == number);
        assert (high <= clocks);
        assert (\dut.phase_q <= 5);
        assert (\dut.turns_q <= 104);
    end
    // A frame leaves nothing behind, so the next begins as the first one did.
    wire looking = \dut.phase_q == 2;
    wire sending = \dut.phase_q == 3 || \dut.phase_q == 4;
    always @* if (known && !looking) assert (!\dut.found_q && \dut.place_q == 0);
    always @* if (known && !looking && !sending) assert (!\dut.at_zero_q && \dut.run_q == 0);
    // What is loaded is what was counted.
    always @* if (loaded) begin
        assert (\dut.low_q [7:0] == 1);
        assert (\dut.low_q [23:8] == numbered);
        assert (\dut.low_q [55:24] == width);
        assert (\dut.upper_q [31:0] == period);
        assert (\dut.upper_q [47:32] == state);
        assert (\dut.upper_q [63:48] == 0);
    end

    always @* cover (known && loaded && width == 2);
endmodule
