// SPDX-License-Identifier: MIT OR Apache-2.0
// uart_transmitter: Bytes out on one wire

`default_nettype none

module uart_transmitter (
    // clock: FPGA clock, rising edge
    input  wire         clock,
    // clear: line at rest
    input  wire         clear,
    // bit_clocks: clocks of a bit, 2 or more
    input  wire [11:0]  bit_clocks,
    // send: high for one clock: data goes out
    input  wire         send,
    // data: the byte, lowest bit first
    input  wire [7:0]   data,
    // line: the wire, high at rest
    output wire         line,
    // ready: a byte may be sent
    output wire         ready
);

    wire [7:0] inverted;
    wire [8:0] widened;
    wire [8:0] loaded;
    wire [8:0] shifted;
    wire [3:0] fewer_bits;
    wire [11:0] fewer_clocks;
    wire idle;
    wire bit_ends;
    reg [8:0] shift_d;
    reg [8:0] shift_q;
    reg [3:0] bits_left_d;
    reg [3:0] bits_left_q;
    reg [11:0] clocks_left_d;
    reg [11:0] clocks_left_q;

    assign inverted = ~data;
    assign widened = {1'b0, inverted};
    assign loaded = (widened << 9'h1) | 9'h1;
    assign shifted = {1'b0, shift_q[8:1]};
    assign fewer_bits = bits_left_q - 4'd1;
    assign fewer_clocks = clocks_left_q - 12'h1;
    assign idle = bits_left_q == 4'd0;
    assign bit_ends = clocks_left_q == 12'h1;

    always @* begin
        shift_d = shift_q;
        bits_left_d = bits_left_q;
        clocks_left_d = clocks_left_q;
        if (clear) begin
            shift_d = 9'h0;
            bits_left_d = 4'd0;
        end else if (idle & send) begin
            shift_d = loaded;
            bits_left_d = 4'd10;
            clocks_left_d = bit_clocks;
        end else if (~idle & bit_ends) begin
            shift_d = shifted;
            bits_left_d = fewer_bits;
            clocks_left_d = bit_clocks;
        end else if (~idle) begin
            clocks_left_d = fewer_clocks;
        end
    end

    assign line = ~shift_q[0];
    assign ready = idle;

    initial begin
        shift_q = 9'h0;
        bits_left_q = 4'd0;
        clocks_left_q = 12'h0;
    end

    always @(posedge clock) begin
        shift_q <= shift_d;
        bits_left_q <= bits_left_d;
        clocks_left_q <= clocks_left_d;
    end
endmodule

`default_nettype wire
