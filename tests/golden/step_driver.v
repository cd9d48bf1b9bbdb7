// SPDX-License-Identifier: MIT OR Apache-2.0
// step_driver: Pulse and direction for a bought stepper driver

`default_nettype none

module step_driver (
    // clock: FPGA clock, rising edge
    input  wire         clock,
    // clear: pulse away
    input  wire         clear,
    // step: high for one clock: a step is taken
    input  wire         step,
    // forward: its direction
    input  wire         forward,
    // step_pin: low for 64 clocks after that, then high for 64
    output wire         step_pin,
    // direction_pin: that direction, until the next step
    output wire         direction_pin
);

    wire [7:0] one_less;
    wire idle;
    reg [7:0] left_d;
    reg [7:0] left_q;
    reg pulse_d;
    reg pulse_q;
    reg direction_d;
    reg direction_q;

    assign one_less = left_q - 8'h1;
    assign idle = left_q == 8'h0;

    always @* begin
        left_d = left_q;
        direction_d = direction_q;
        if (clear) begin
            left_d = 8'h0;
            direction_d = 1'b0;
        end else if (step) begin
            left_d = 8'h80;
            direction_d = forward;
        end else if (~idle) begin
            left_d = one_less;
        end
    end

    always @* begin
        pulse_d = pulse_q;
        if (clear | step) begin
            pulse_d = 1'b0;
        end else begin
            pulse_d = (8'h2 <= left_q) & (left_q <= 8'h41);
        end
    end

    assign step_pin = pulse_q;
    assign direction_pin = direction_q;

    initial begin
        left_q = 8'h0;
        pulse_q = 1'b0;
        direction_q = 1'b0;
    end

    always @(posedge clock) begin
        left_q <= left_d;
        pulse_q <= pulse_d;
        direction_q <= direction_d;
    end
endmodule

`default_nettype wire
