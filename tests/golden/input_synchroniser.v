// SPDX-License-Identifier: MIT OR Apache-2.0
// input_synchroniser: Two flip-flops and a rising edge: one pulse for each line or fringe

`default_nettype none

module input_synchroniser (
    // clock: FPGA clock, rising edge
    input  wire         clock,
    // pin: grating lines, laser fringes or a push button, at any time
    input  wire         pin,
    // rising: high for one clock, two rising clock edges after pin rose
    output wire         rising
);

    wire first_d;
    (* ASYNC_REG = "TRUE", keep = "true" *) reg first_q;
    wire second_d;
    (* ASYNC_REG = "TRUE", keep = "true" *) reg second_q;
    wire before_d;
    reg before_q;

    assign first_d = pin;
    assign second_d = first_q;
    assign before_d = second_q;
    assign rising = second_q & ~before_q;

    initial begin
        first_q = 1'b0;
        second_q = 1'b0;
        before_q = 1'b0;
    end

    always @(posedge clock) begin
        first_q <= first_d;
        second_q <= second_d;
        before_q <= before_d;
    end
endmodule

`default_nettype wire
