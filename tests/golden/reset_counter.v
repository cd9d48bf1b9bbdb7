// SPDX-License-Identifier: MIT OR Apache-2.0
// reset_counter: Counts the steps and plays them back to zero (fig. 17)

`default_nettype none

module reset_counter (
    // clock: FPGA clock, rising edge
    input  wire         clock,
    // clear: here is zero; no fault
    input  wire         clear,
    // request: high for one clock: a step is asked for
    input  wire         request,
    // forward: its direction, unless played back
    input  wire         forward,
    // playback: go back to zero and stay there
    input  wire         playback,
    // step: the step is taken: ring and counter both move
    output wire         step,
    // drive_forward: its direction
    output wire         drive_forward,
    // count: steps away from zero, 0 to 4095
    output wire [11:0]  count,
    // count_forward: on which side of zero; at zero, where it last was
    output wire         count_forward,
    // zero: the count is zero (line 158 of the figure)
    output wire         zero,
    // fault: a step was refused at 4095; until zero is reached again
    output wire         fault
);

    wire [11:0] one_more;
    wire [11:0] one_less;
    wire at_zero;
    wire at_limit;
    reg direction;
    wire away;
    wire refusing;
    wire taken;
    reg [11:0] magnitude_d;
    reg [11:0] magnitude_q;
    reg side_d;
    reg side_q;
    reg refused_d;
    reg refused_q;

    assign one_more = magnitude_q + 12'h1;
    assign one_less = magnitude_q - 12'h1;
    assign at_zero = magnitude_q == 12'h0;
    assign at_limit = &magnitude_q;

    always @* begin
        if (playback) begin
            direction = ~side_q;
        end else begin
            direction = forward;
        end
    end

    assign away = at_zero | (direction == side_q);
    assign refusing = request & at_limit & away;
    assign taken = request & ~clear & ~refusing & ~(at_zero & playback);

    always @* begin
        magnitude_d = magnitude_q;
        side_d = side_q;
        if (clear) begin
            magnitude_d = 12'h0;
            side_d = 1'b0;
        end else if (taken & away) begin
            magnitude_d = one_more;
            side_d = direction;
        end else if (taken) begin
            magnitude_d = one_less;
        end
    end

    always @* begin
        refused_d = refused_q;
        if (clear | at_zero) begin
            refused_d = 1'b0;
        end else if (refusing) begin
            refused_d = 1'b1;
        end
    end

    assign step = taken;
    assign drive_forward = direction;
    assign count = magnitude_q;
    assign count_forward = side_q;
    assign zero = at_zero;
    assign fault = refused_q;

    initial begin
        magnitude_q = 12'h0;
        side_q = 1'b0;
        refused_q = 1'b0;
    end

    always @(posedge clock) begin
        magnitude_q <= magnitude_d;
        side_q <= side_d;
        refused_q <= refused_d;
    end
endmodule

`default_nettype wire
