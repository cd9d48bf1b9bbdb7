// SPDX-License-Identifier: MIT OR Apache-2.0
// step_clock: Free-running oscillator whose frequency is the correction speed (fig. 14)

`default_nettype none

module step_clock (
    // clock: FPGA clock, rising edge
    input  wire         clock,
    // clear: a whole period from now to the next tick
    input  wire         clear,
    // period: clocks from tick to tick, 1 to 16 777 215; 0 stops it
    input  wire [23:0]  period,
    // tick: high for one clock
    output wire         tick
);

    wire [23:0] one_less;
    wire last;
    wire stopped;
    reg [23:0] left_d;
    reg [23:0] left_q;

    assign one_less = left_q - 24'h1;
    assign last = left_q == 24'h1;
    assign stopped = left_q == 24'h0;

    always @* begin
        left_d = left_q;
        if (clear | last | stopped) begin
            left_d = period;
        end else begin
            left_d = one_less;
        end
    end

    assign tick = last;

    initial begin
        left_q = 24'h0;
    end

    always @(posedge clock) begin
        left_q <= left_d;
    end
endmodule

`default_nettype wire
