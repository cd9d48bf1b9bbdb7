// subdivided_comparison: Where between two input pulses an output pulse falls, as a fraction
// | (document 4)

`default_nettype none

module subdivided_comparison (
    input  wire         clock,
    input  wire         clear,
    input  wire         fast,
    input  wire         slow,
    output wire [15:0]  fraction,
    output wire [15:0]  pulses,
    output wire         ready
);

    wire [32:0] one_more;
    wire full;
    reg [32:0] since_now;
    reg [32:0] period_now;
    reg known_now;
    wire [15:0] counted_more;
    reg [15:0] counted_now;
    wire busy;
    wire take;
    wire beyond;
    wire [32:0] doubled;
    wire fits;
    wire [32:0] reduced;
    wire [15:0] shifted;
    wire [15:0] shifted_one;
    wire [4:0] left_less;
    reg [32:0] since_d;
    reg [32:0] since_q;
    reg [32:0] last_period_d;
    reg [32:0] last_period_q;
    reg seen_d;
    reg seen_q;
    reg known_d;
    reg known_q;
    reg [15:0] counted_d;
    reg [15:0] counted_q;
    reg [15:0] pulses_latch_d;
    reg [15:0] pulses_latch_q;
    reg [32:0] remainder_d;
    reg [32:0] remainder_q;
    reg [32:0] divisor_d;
    reg [32:0] divisor_q;
    reg [15:0] quotient_d;
    reg [15:0] quotient_q;
    reg [4:0] left_d;
    reg [4:0] left_q;
    wire done_d;
    reg done_q;

    assign one_more = since_q + 33'h1;
    assign full = since_q[32];

    always @* begin
        since_d = since_q;
        last_period_d = last_period_q;
        seen_d = seen_q;
        known_d = known_q;
        if (fast) begin
            since_now = 33'h0;
            period_now = since_q;
            known_now = seen_q;
            since_d = 33'h1;
            last_period_d = since_q;
            known_d = seen_q;
            seen_d = 1'b1;
        end else begin
            since_now = since_q;
            period_now = last_period_q;
            known_now = known_q;
            if (~full) begin
                since_d = one_more;
            end
        end
        if (clear) begin
            seen_d = 1'b0;
            known_d = 1'b0;
        end
    end

    assign counted_more = counted_q + 16'h1;

    always @* begin
        if (fast) begin
            counted_now = counted_more;
        end else begin
            counted_now = counted_q;
        end
    end

    assign busy = |left_q;
    assign take = slow & known_now & ~busy & ~clear;

    always @* begin
        counted_d = counted_q;
        if (take | clear) begin
            counted_d = 16'h0;
        end else begin
            counted_d = counted_now;
        end
    end

    assign doubled = remainder_q << 33'h1;
    assign reduced = doubled - divisor_q;
    assign shifted = quotient_q << 16'h1;
    assign shifted_one = shifted + 16'h1;
    assign left_less = left_q - 5'h1;
    assign beyond = period_now <= since_now;
    assign fits = divisor_q <= doubled;

    always @* begin
        pulses_latch_d = pulses_latch_q;
        remainder_d = remainder_q;
        divisor_d = divisor_q;
        quotient_d = quotient_q;
        if (take) begin
            quotient_d = 16'h0;
            pulses_latch_d = counted_now;
            remainder_d = since_now;
            divisor_d = period_now;
        end else if (busy & fits) begin
            remainder_d = reduced;
            quotient_d = shifted_one;
        end else if (busy) begin
            remainder_d = doubled;
            quotient_d = shifted;
        end
        if (take & beyond) begin
            remainder_d = 33'h0;
            divisor_d = 33'h0;
        end
    end

    always @* begin
        left_d = left_q;
        if (clear) begin
            left_d = 5'h0;
        end else if (take) begin
            left_d = 5'h10;
        end else if (busy) begin
            left_d = left_less;
        end
    end

    assign done_d = (left_q == 5'h1) & ~clear;
    assign fraction = quotient_q;
    assign pulses = pulses_latch_q;
    assign ready = done_q;

    initial begin
        since_q = 33'h0;
        last_period_q = 33'h0;
        seen_q = 1'b0;
        known_q = 1'b0;
        counted_q = 16'h0;
        pulses_latch_q = 16'h0;
        remainder_q = 33'h0;
        divisor_q = 33'h0;
        quotient_q = 16'h0;
        left_q = 5'h0;
        done_q = 1'b0;
    end

    always @(posedge clock) begin
        since_q <= since_d;
        last_period_q <= last_period_d;
        seen_q <= seen_d;
        known_q <= known_d;
        counted_q <= counted_d;
        pulses_latch_q <= pulses_latch_d;
        remainder_q <= remainder_d;
        divisor_q <= divisor_d;
        quotient_q <= quotient_d;
        left_q <= left_d;
        done_q <= done_d;
    end
endmodule

`default_nettype wire
