// SPDX-License-Identifier: MIT OR Apache-2.0
// standard_wave: Square wave of half a comparison period, from the grating (fig. 16)

`default_nettype none

module standard_wave (
    // clock: FPGA clock, rising edge
    input  wire         clock,
    // clear: low, until the next period starts
    input  wire         clear,
    // divided: grating pulses ÷A
    input  wire         divided,
    // start: those of them that start a comparison period, as the meter's
    input  wire         start,
    // half: divider A has counted ⌊A/2⌋
    input  wire         half,
    // range_x2: ×2 instead of ×1
    input  wire         range_x2,
    // standard: the square wave, registered
    output wire         standard
);

    reg middle;
    reg wave_d;
    reg wave_q;

    always @* begin
        if (range_x2) begin
            middle = divided;
        end else begin
            middle = half;
        end
    end

    always @* begin
        wave_d = wave_q;
        if (clear) begin
            wave_d = 1'b0;
        end else if (start) begin
            wave_d = 1'b1;
        end else if (middle) begin
            wave_d = 1'b0;
        end
    end

    assign standard = wave_q;

    initial begin
        wave_q = 1'b0;
    end

    always @(posedge clock) begin
        wave_q <= wave_d;
    end
endmodule

`default_nettype wire
