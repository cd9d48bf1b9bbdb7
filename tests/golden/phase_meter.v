// SPDX-License-Identifier: MIT OR Apache-2.0
// phase_meter: Set by the grating, cleared by the laser: its mean is the phase (figs. 3, 6)

`default_nettype none

module phase_meter (
    // clock: FPGA clock, rising edge
    input  wire         clock,
    // hold: low, whatever comes: the initial phase is being selected
    input  wire         hold,
    // grating: high for one clock: sets
    input  wire         grating,
    // laser: high for one clock: clears
    input  wire         laser,
    // meter: the pulse whose width is the phase, registered
    output wire         meter
);

    reg state_d;
    reg state_q;

    always @* begin
        state_d = state_q;
        if (hold) begin
            state_d = 1'b0;
        end else if (grating & ~laser) begin
            state_d = 1'b1;
        end else if (laser & ~grating) begin
            state_d = 1'b0;
        end
    end

    assign meter = state_q;

    initial begin
        state_q = 1'b0;
    end

    always @(posedge clock) begin
        state_q <= state_d;
    end
endmodule

`default_nettype wire
