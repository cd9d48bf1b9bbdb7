// Chooses who moves the motor: the discriminator, the panel or the playback (fig. 14)

`default_nettype none

module step_selector (
    input  wire         clock,
    input  wire         clear,
    input  wire         tick,
    input  wire         correcting,
    input  wire         automatic_forward,
    input  wire         manual_enable,
    input  wire         manual_step,
    input  wire         manual_forward,
    input  wire         playback,
    output wire         request,
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
