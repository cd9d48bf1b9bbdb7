// SPDX-License-Identifier: MIT OR Apache-2.0
// step_selector: Chooses who moves the motor: the discriminator, the panel or the playback (fig.
// | 14)

`default_nettype none

module step_selector (
    // clock: FPGA clock, rising edge
    input  wire         clock,
    // clear: forgets a manual step that waits
    input  wire         clear,
    // tick: the step clock
    input  wire         tick,
    // correcting: the loop has decided and may step
    input  wire         correcting,
    // automatic_forward: the discriminator's Q
    input  wire         automatic_forward,
    // manual_enable: the panel may step: not in the correct position
    input  wire         manual_enable,
    // manual_step: high for one clock per press
    input  wire         manual_step,
    // manual_forward: direction switch of the panel
    input  wire         manual_forward,
    // playback: steps are being played back
    input  wire         playback,
    // request: high for one clock: a step is asked for
    output wire         request,
    // forward: its direction, if it is not played back
    output reg          forward
);

    wire manual;
    reg waiting_d;
    reg waiting_q;

    assign manual = waiting_q & manual_enable & ~playback;

    always @* begin
        waiting_d = waiting_q;
        if (clear | playback | ~manual_enable) begin
            waiting_d = 1'b0;
        end else if (manual_step) begin
            waiting_d = 1'b1;
        end else if (tick) begin
            waiting_d = 1'b0;
        end
    end

    assign request = tick & (playback | correcting | manual);

    always @* begin
        if (manual & ~correcting) begin
            forward = manual_forward;
        end else begin
            forward = automatic_forward;
        end
    end

    initial begin
        waiting_q = 1'b0;
    end

    always @(posedge clock) begin
        waiting_q <= waiting_d;
    end
endmodule

`default_nettype wire
