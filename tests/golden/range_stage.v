// SPDX-License-Identifier: MIT OR Apache-2.0
// range_stage: Divides by a further two in the x2 range

`default_nettype none

module range_stage (
    // clock: FPGA clock, rising edge
    input  wire         clock,
    // clear: the next pulse is a first one
    input  wire         clear,
    // divided: high for one clock per pulse of the divider
    input  wire         divided,
    // range_x2: ×2 instead of ×1
    input  wire         range_x2,
    // pulse: every pulse at ×1; the 1st, 3rd, 5th … at ×2
    output wire         pulse
);

    reg second_d;
    reg second_q;

    always @* begin
        second_d = second_q;
        if (clear) begin
            second_d = 1'b0;
        end else if (divided) begin
            second_d = ~second_q;
        end
    end

    assign pulse = divided & ~(second_q & range_x2);

    initial begin
        second_q = 1'b0;
    end

    always @(posedge clock) begin
        second_q <= second_d;
    end
endmodule

`default_nettype wire
