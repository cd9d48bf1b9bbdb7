// SPDX-License-Identifier: MIT OR Apache-2.0
// initial_phase_selector: Lets the grating through once m laser pulses have passed (fig. 8)

`default_nettype none

module initial_phase_selector (
    // clock: FPGA clock, rising edge
    input  wire         clock,
    // clear: back to zero, gate shut
    input  wire         clear,
    // laser: high for one clock per compensated laser pulse
    input  wire         laser,
    // grating: high for one clock per grating line
    input  wire         grating,
    // preset: m, three BCD digits
    input  wire [11:0]  preset,
    // open: the gate is open: the phase is selected, measuring begins
    output wire         open,
    // line: grating lines that pass the gate
    output wire         line
);

    wire coincidence;
    wire units_count;
    wire [3:0] units_digit;
    wire units_carry;
    wire [3:0] tens_digit;
    wire tens_carry;
    wire [3:0] hundreds_digit;
    wire hundreds_carry;
    reg gate_d;
    reg gate_q;

    decade_counter units (
        .clock(clock),
        .clear(clear),
        .count(units_count),
        .digit(units_digit),
        .carry(units_carry)
    );

    decade_counter tens (
        .clock(clock),
        .clear(clear),
        .count(units_carry),
        .digit(tens_digit),
        .carry(tens_carry)
    );

    decade_counter hundreds (
        .clock(clock),
        .clear(clear),
        .count(tens_carry),
        .digit(hundreds_digit),
        .carry(hundreds_carry)
    );

    assign coincidence = (units_digit == preset[3:0]) & (tens_digit == preset[7:4])
        & (hundreds_digit == preset[11:8]);
    assign units_count = laser & ~clear & ~coincidence & ~gate_q;

    always @* begin
        gate_d = gate_q;
        if (clear) begin
            gate_d = 1'b0;
        end else if (coincidence) begin
            gate_d = 1'b1;
        end
    end

    assign open = gate_q;
    assign line = grating & gate_q;

    initial begin
        gate_q = 1'b0;
    end

    always @(posedge clock) begin
        gate_q <= gate_d;
    end

    // Without a reader here; named so that linters know it is meant.
    wire unused_bits = &{1'b0, hundreds_carry};
endmodule

`default_nettype wire
