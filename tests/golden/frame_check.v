// SPDX-License-Identifier: MIT OR Apache-2.0
// frame_check: CRC of a frame, bit by bit

`default_nettype none

module frame_check (
    // clock: FPGA clock, rising edge
    input  wire         clock,
    // clear: a frame begins
    input  wire         clear,
    // take: high for one clock: level is the next bit
    input  wire         take,
    // level: that bit
    input  wire         level,
    // check: the check of the bits so far, low byte to be sent first
    output wire [15:0]  check
);

    wire [15:0] shifted;
    wire feedback;
    reg [15:0] inverse_d;
    reg [15:0] inverse_q;

    assign feedback = ~inverse_q[0] ^ level;
    assign shifted = {1'b0, inverse_q[15:1]} | 16'h8000;

    always @* begin
        inverse_d = inverse_q;
        if (clear) begin
            inverse_d = 16'h0;
        end else if (take & feedback) begin
            inverse_d = shifted ^ 16'h8408;
        end else if (take) begin
            inverse_d = shifted;
        end
    end

    assign check = inverse_q;

    initial begin
        inverse_q = 16'h0;
    end

    always @(posedge clock) begin
        inverse_q <= inverse_d;
    end
endmodule

`default_nettype wire
