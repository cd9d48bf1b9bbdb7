// SPDX-License-Identifier: MIT OR Apache-2.0
// cumulative_compensator: Blocks or inserts one laser pulse in F (fig. 9)

`default_nettype none

module cumulative_compensator (
    // clock: FPGA clock, rising edge
    input  wire         clock,
    // clear: divider to zero, nothing owed
    input  wire         clear,
    // laser: high for one clock per fringe
    input  wire         laser,
    // preset: F/1000, four BCD digits; 0000 is off
    input  wire [15:0]  preset,
    // insert: insert (ΔS < 0) instead of block (ΔS > 0)
    input  wire         insert,
    // pulse: the compensated train, for divider B and the phase selector
    output wire         pulse
);

    wire pending;
    wire payable;
    wire divider_due;
    reg owed_d;
    reg owed_q;

    compensation_divider divider (
        .clock(clock),
        .clear(clear),
        .pulse(laser),
        .preset(preset),
        .due(divider_due)
    );

    assign pending = divider_due | owed_q;
    assign payable = laser ^ insert;

    always @* begin
        owed_d = owed_q;
        if (clear) begin
            owed_d = 1'b0;
        end else begin
            owed_d = pending & ~payable;
        end
    end

    assign pulse = laser ^ (pending & payable);

    initial begin
        owed_q = 1'b0;
    end

    always @(posedge clock) begin
        owed_q <= owed_d;
    end
endmodule

`default_nettype wire
