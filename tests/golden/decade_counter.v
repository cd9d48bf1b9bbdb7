// SPDX-License-Identifier: MIT OR Apache-2.0
// decade_counter: One decimal digit with carry (fig. 7)

`default_nettype none

module decade_counter (
    // clock: FPGA clock, rising edge
    input  wire         clock,
    // clear: to zero
    input  wire         clear,
    // count: high for one clock: one up
    input  wire         count,
    // digit: 0 to 9, BCD
    output wire [3:0]   digit,
    // carry: high while this count takes the digit from 9 to 0
    output wire         carry
);

    wire [3:0] one_more;
    wire full;
    wire wrap;
    reg [3:0] state_d;
    reg [3:0] state_q;

    assign one_more = state_q + 4'd1;
    assign full = 4'd9 <= state_q;
    assign wrap = count & full & ~clear;

    always @* begin
        state_d = state_q;
        if (clear & count) begin
            state_d = 4'd1;
        end else if (clear | wrap) begin
            state_d = 4'd0;
        end else if (count) begin
            state_d = one_more;
        end
    end

    assign digit = state_q;
    assign carry = wrap;

    initial begin
        state_q = 4'd0;
    end

    always @(posedge clock) begin
        state_q <= state_d;
    end
endmodule

`default_nettype wire
