// digital_comparison: Clocks between two pulses and from period to period (document 4)

`default_nettype none

module digital_comparison (
    input  wire         clock,
    input  wire         clear,
    input  wire         opening,
    input  wire         shutting,
    output wire [31:0]  delay,
    output wire         delay_ready,
    output wire [31:0]  period,
    output wire         period_ready
);

    wire [31:0] one_more;
    wire full;
    reg [31:0] since_d;
    reg [31:0] since_q;
    reg begun_d;
    reg begun_q;
    reg gate_d;
    reg gate_q;
    reg [31:0] delay_latch_d;
    reg [31:0] delay_latch_q;
    reg [31:0] period_latch_d;
    reg [31:0] period_latch_q;
    wire delay_new_d;
    reg delay_new_q;
    wire period_new_d;
    reg period_new_q;

    assign one_more = since_q + 32'h1;
    assign full = &since_q;

    always @* begin
        since_d = since_q;
        if (opening) begin
            since_d = 32'h1;
        end else if (~full) begin
            since_d = one_more;
        end
    end

    always @* begin
        begun_d = begun_q;
        gate_d = gate_q;
        if (clear) begin
            begun_d = 1'b0;
            gate_d = 1'b0;
        end else if (opening) begin
            begun_d = 1'b1;
            gate_d = ~shutting;
        end else if (shutting) begin
            gate_d = 1'b0;
        end
    end

    always @* begin
        delay_latch_d = delay_latch_q;
        if (opening & shutting) begin
            delay_latch_d = 32'h0;
        end else if (gate_q & shutting) begin
            delay_latch_d = since_q;
        end
    end

    assign delay_new_d = shutting & (opening | gate_q) & ~clear;

    always @* begin
        period_latch_d = period_latch_q;
        if (begun_q & opening) begin
            period_latch_d = since_q;
        end
    end

    assign period_new_d = begun_q & opening & ~clear;
    assign delay = delay_latch_q;
    assign delay_ready = delay_new_q;
    assign period = period_latch_q;
    assign period_ready = period_new_q;

    initial begin
        since_q = 32'h0;
        begun_q = 1'b0;
        gate_q = 1'b0;
        delay_latch_q = 32'h0;
        period_latch_q = 32'h0;
        delay_new_q = 1'b0;
        period_new_q = 1'b0;
    end

    always @(posedge clock) begin
        since_q <= since_d;
        begun_q <= begun_d;
        gate_q <= gate_d;
        delay_latch_q <= delay_latch_d;
        period_latch_q <= period_latch_d;
        delay_new_q <= delay_new_d;
        period_new_q <= period_new_d;
    end
endmodule

`default_nettype wire
