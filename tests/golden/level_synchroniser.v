// SPDX-License-Identifier: MIT OR Apache-2.0
// level_synchroniser: Two flip-flops between a panel switch and the logic

`default_nettype none

module level_synchroniser (
    // clock: FPGA clock, rising edge
    input  wire         clock,
    // pin: the switch, at any time
    input  wire         pin,
    // level: the same level, two rising edges later
    output wire         level
);

    wire first_d;
    (* ASYNC_REG = "TRUE", keep = "true" *) reg first_q;
    wire second_d;
    (* ASYNC_REG = "TRUE", keep = "true" *) reg second_q;

    assign first_d = pin;
    assign second_d = first_q;
    assign level = second_q;

    initial begin
        first_q = 1'b0;
        second_q = 1'b0;
    end

    always @(posedge clock) begin
        first_q <= first_d;
        second_q <= second_d;
    end
endmodule

`default_nettype wire
