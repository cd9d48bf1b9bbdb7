// SPDX-License-Identifier: MIT OR Apache-2.0
// programmable_divider: Three decades and their coincidence: one pulse in 1 to 999 (fig. 7)

`default_nettype none

module programmable_divider (
    // clock: FPGA clock, rising edge
    input  wire         clock,
    // clear: back to zero; pulses are not counted meanwhile
    input  wire         clear,
    // pulse: high for one clock per pulse to count
    input  wire         pulse,
    // preset: N, three BCD digits, hundreds on top
    input  wire [11:0]  preset,
    // divided: high for one clock, the clock after every N-th pulse
    output wire         divided,
    // half: high while the count is ⌊N/2⌋
    output wire         half
);

    wire coincidence;
    wire restart;
    wire [3:0] tens_halved;
    wire [3:0] units_halved;
    wire [3:0] half_hundreds;
    reg [3:0] half_tens;
    reg [3:0] half_units;
    wire units_count;
    wire [3:0] units_digit;
    wire units_carry;
    wire [3:0] tens_digit;
    wire tens_carry;
    wire [3:0] hundreds_digit;
    wire hundreds_carry;

    decade_counter units (
        .clock(clock),
        .clear(restart),
        .count(units_count),
        .digit(units_digit),
        .carry(units_carry)
    );

    decade_counter tens (
        .clock(clock),
        .clear(restart),
        .count(units_carry),
        .digit(tens_digit),
        .carry(tens_carry)
    );

    decade_counter hundreds (
        .clock(clock),
        .clear(restart),
        .count(tens_carry),
        .digit(hundreds_digit),
        .carry(hundreds_carry)
    );

    assign coincidence = (units_digit == preset[3:0]) & (tens_digit == preset[7:4])
        & (hundreds_digit == preset[11:8]);
    assign restart = coincidence | clear;
    assign units_count = pulse & ~clear;
    assign half_hundreds = {1'b0, preset[11:9]};
    assign tens_halved = {1'b0, preset[7:5]};
    assign units_halved = {1'b0, preset[3:1]};

    always @* begin
        if (preset[8]) begin
            half_tens = tens_halved + 4'd5;
        end else begin
            half_tens = tens_halved;
        end
    end

    always @* begin
        if (preset[4]) begin
            half_units = units_halved + 4'd5;
        end else begin
            half_units = units_halved;
        end
    end

    assign half = (units_digit == half_units) & (tens_digit == half_tens)
        & (hundreds_digit == half_hundreds);
    assign divided = coincidence;

    // Without a reader here; named so that linters know it is meant.
    wire unused_bits = &{1'b0, hundreds_carry};
endmodule

`default_nettype wire
