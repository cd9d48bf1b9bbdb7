// SPDX-License-Identifier: MIT OR Apache-2.0
// direction_discriminator: Wider than the standard: forward; narrower: reverse (figs. 15, 16)

`default_nettype none

module direction_discriminator (
    // clock: FPGA clock, rising edge
    input  wire         clock,
    // clear: Q low, nothing decided
    input  wire         clear,
    // hold: no pulses, nothing decided; Q stays
    input  wire         hold,
    // meter: the measured pulse
    input  wire         meter,
    // standard: the standard square wave
    input  wire         standard,
    // cp1: clock that sets Q, active low (point 5 of the figure)
    output wire         cp1,
    // cp2: clock that clears Q, active low (point 6)
    output wire         cp2,
    // q: motor forward, negative correction
    output wire         q,
    // q_bar: motor reverse, positive correction
    output wire         q_bar,
    // decided: Q is a decision of this pass
    output wire         decided
);

    wire nand1;
    wire nand2;
    wire nand3;
    reg jk_d;
    reg jk_q;
    reg decision_d;
    reg decision_q;

    assign nand3 = ~standard;
    assign nand1 = ~(meter & nand3 & ~hold);
    assign nand2 = ~(~meter & standard & ~hold);

    always @* begin
        jk_d = jk_q;
        if (clear) begin
            jk_d = 1'b0;
        end else if (~nand1) begin
            jk_d = 1'b1;
        end else if (~nand2) begin
            jk_d = 1'b0;
        end
    end

    always @* begin
        decision_d = decision_q;
        if (clear | hold) begin
            decision_d = 1'b0;
        end else if (~(nand1 & nand2)) begin
            decision_d = 1'b1;
        end
    end

    assign cp1 = nand1;
    assign cp2 = nand2;
    assign q = jk_q;
    assign q_bar = ~jk_q;
    assign decided = decision_q;

    initial begin
        jk_q = 1'b0;
        decision_q = 1'b0;
    end

    always @(posedge clock) begin
        jk_q <= jk_d;
        decision_q <= decision_d;
    end
endmodule

`default_nettype wire
