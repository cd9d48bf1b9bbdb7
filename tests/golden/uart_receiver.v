// SPDX-License-Identifier: MIT OR Apache-2.0
// uart_receiver: Bytes in from one wire

`default_nettype none

module uart_receiver (
    // clock: FPGA clock, rising edge
    input  wire         clock,
    // clear: no byte under way
    input  wire         clear,
    // bit_clocks: clocks of a bit, 2 or more
    input  wire [11:0]  bit_clocks,
    // line: the wire, high at rest
    input  wire         line,
    // received: high for one clock: data is a byte that came over whole
    output wire         received,
    // data: that byte, until the first bit of the next one
    output wire [7:0]   data
);

    reg [7:0] shifted;
    wire [11:0] half_bit;
    wire [3:0] fewer_bits;
    wire [11:0] fewer_clocks;
    wire low;
    wire idle;
    wire middle;
    wire starting;
    wire stopping;
    wire synchroniser_pin;
    wire synchroniser_level;
    reg [7:0] shift_d;
    reg [7:0] shift_q;
    reg [3:0] bits_left_d;
    reg [3:0] bits_left_q;
    reg [11:0] clocks_left_d;
    reg [11:0] clocks_left_q;

    level_synchroniser synchroniser (
        .clock(clock),
        .pin(synchroniser_pin),
        .level(synchroniser_level)
    );

    assign synchroniser_pin = ~line;
    assign low = synchroniser_level;
    assign half_bit = {1'b0, bit_clocks[11:1]};
    assign fewer_bits = bits_left_q - 4'd1;
    assign fewer_clocks = clocks_left_q - 12'h1;
    assign idle = bits_left_q == 4'd0;
    assign middle = clocks_left_q == 12'h1;
    assign starting = bits_left_q == 4'd10;
    assign stopping = bits_left_q == 4'd1;

    always @* begin
        shifted = {1'b0, shift_q[7:1]};
        if (~low) begin
            shifted = {1'b0, shift_q[7:1]} | 8'h80;
        end
    end

    always @* begin
        shift_d = shift_q;
        bits_left_d = bits_left_q;
        clocks_left_d = clocks_left_q;
        if (clear | (starting & middle & ~low)) begin
            bits_left_d = 4'd0;
        end else if (idle & low) begin
            bits_left_d = 4'd10;
            clocks_left_d = half_bit;
        end else if (~idle & middle) begin
            bits_left_d = fewer_bits;
            clocks_left_d = bit_clocks;
            if (~stopping) begin
                shift_d = shifted;
            end
        end else if (~idle) begin
            clocks_left_d = fewer_clocks;
        end
    end

    assign received = stopping & middle & ~low;
    assign data = shift_q;

    initial begin
        shift_q = 8'h0;
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
