// SPDX-License-Identifier: MIT OR Apache-2.0
// calibrator: Puts a known phase on the meter outputs (figs. 11, 12)

`default_nettype none

module calibrator (
    // clock: FPGA clock, rising edge
    input  wire         clock,
    // clear: start state
    input  wire         clear,
    // line: high for one clock per grating line, gated or not
    input  wire         line,
    // meter: the measured pulse
    input  wire         meter,
    // calibrate: 0 measured, 1 180°, 2 90° below it, 3 45° below it
    input  wire [1:0]   calibrate,
    // t1: meter output
    output wire         t1,
    // t2: its complement
    output wire         t2
);

    wire [2:0] next_eighth;
    wire clamp;
    reg shown;
    reg [2:0] eighth_d;
    reg [2:0] eighth_q;

    assign clamp = clear | (calibrate == 2'd0);
    assign next_eighth = eighth_q + 3'd1;

    always @* begin
        eighth_d = eighth_q;
        if (clamp) begin
            eighth_d = 3'd0;
        end else if (line) begin
            eighth_d = next_eighth;
        end
    end

    always @* begin
        if (calibrate == 2'd1) begin
            shown = eighth_q < 3'd4;
        end else if (calibrate == 2'd2) begin
            shown = eighth_q < 3'd2;
        end else if (calibrate == 2'd3) begin
            shown = eighth_q < 3'd3;
        end else begin
            shown = meter;
        end
    end

    assign t1 = shown;
    assign t2 = ~shown;

    initial begin
        eighth_q = 3'd0;
    end

    always @(posedge clock) begin
        eighth_q <= eighth_d;
    end
endmodule

`default_nettype wire
