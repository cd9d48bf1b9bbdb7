// SPDX-License-Identifier: MIT OR Apache-2.0
// compensation_divider: Seven decades of which four are set: one pulse in F (fig. 9)

`default_nettype none

module compensation_divider (
    // clock: FPGA clock, rising edge
    input  wire         clock,
    // clear: back to zero; pulses are not counted meanwhile
    input  wire         clear,
    // pulse: high for one clock per laser pulse
    input  wire         pulse,
    // preset: F/1000, four BCD digits, millions on top; 0000 is off
    input  wire [15:0]  preset,
    // due: high for one clock, the clock after every F-th pulse
    output wire         due
);

    wire enabled;
    wire line_123;
    wire coincidence;
    wire restart;
    wire units_count;
    wire [3:0] units_digit;
    wire units_carry;
    wire [3:0] tens_digit;
    wire tens_carry;
    wire [3:0] hundreds_digit;
    wire hundreds_carry;
    wire [3:0] thousands_digit;
    wire thousands_carry;
    wire [3:0] ten_thousands_digit;
    wire ten_thousands_carry;
    wire [3:0] hundred_thousands_digit;
    wire hundred_thousands_carry;
    wire [3:0] millions_digit;
    wire millions_carry;

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

    decade_counter thousands (
        .clock(clock),
        .clear(restart),
        .count(hundreds_carry),
        .digit(thousands_digit),
        .carry(thousands_carry)
    );

    decade_counter ten_thousands (
        .clock(clock),
        .clear(restart),
        .count(thousands_carry),
        .digit(ten_thousands_digit),
        .carry(ten_thousands_carry)
    );

    decade_counter hundred_thousands (
        .clock(clock),
        .clear(restart),
        .count(ten_thousands_carry),
        .digit(hundred_thousands_digit),
        .carry(hundred_thousands_carry)
    );

    decade_counter millions (
        .clock(clock),
        .clear(restart),
        .count(hundred_thousands_carry),
        .digit(millions_digit),
        .carry(millions_carry)
    );

    assign enabled = |preset;
    assign line_123 = (units_digit == 4'd0) & (tens_digit == 4'd0) & (hundreds_digit == 4'd0);
    assign coincidence = (thousands_digit == preset[3:0]) & (ten_thousands_digit == preset[7:4])
        & (hundred_thousands_digit == preset[11:8]) & (millions_digit == preset[15:12])
        & line_123 & enabled;
    assign restart = coincidence | clear | ~enabled;
    assign units_count = pulse & enabled & ~clear;
    assign due = coincidence;

    // Without a reader here; named so that linters know it is meant.
    wire unused_bits = &{1'b0, millions_carry};
endmodule

`default_nettype wire
