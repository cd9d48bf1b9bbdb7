// SPDX-License-Identifier: MIT OR Apache-2.0
// supervisor: Watchdogs of lines, fringes and meter, enable and emergency stop

`default_nettype none

module supervisor (
    // clock: FPGA clock, rising edge
    input  wire         clock,
    // clear: forgets what was wrong: no pass runs
    input  wire         clear,
    // tick: high for one clock: the watchdogs count on
    input  wire         tick,
    // limit: ticks without a line or a fringe that are too many; 0 is off
    input  wire [11:0]  limit,
    // wrap_watched: a wrapped meter is wrong
    input  wire         wrap_watched,
    // measuring: the initial phase is selected
    input  wire         measuring,
    // line: high for one clock: a grating line
    input  wire         line,
    // fringe: high for one clock: a fringe
    input  wire         fringe,
    // opening: high for one clock: the meter is set
    input  wire         opening,
    // shutting: high for one clock: the meter is cleared
    input  wire         shutting,
    // enable: steps are allowed
    input  wire         enable,
    // stop: emergency stop
    input  wire         stop,
    // may_correct: the loop may step
    output wire         may_correct,
    // may_step: panel and playback may step
    output wire         may_step,
    // stopped: windings off: the emergency stop, until clear
    output wire         stopped,
    // lines_missing: no line came in time
    output wire         lines_missing,
    // fringes_missing: no fringe came in time
    output wire         fringes_missing,
    // wrapped: set twice without clear between, or cleared twice without set
    output wire         wrapped,
    // alarm: one of these three, or stopped
    output wire         alarm
);

    wire [11:0] line_more;
    wire [11:0] fringe_more;
    wire watched;
    wire again;
    wire wrong;
    reg [11:0] since_line_d;
    reg [11:0] since_line_q;
    reg [11:0] since_fringe_d;
    reg [11:0] since_fringe_q;
    reg no_line_d;
    reg no_line_q;
    reg no_fringe_d;
    reg no_fringe_q;
    reg open_d;
    reg open_q;
    reg order_known_d;
    reg order_known_q;
    reg wrap_d;
    reg wrap_q;
    reg halt_d;
    reg halt_q;

    assign line_more = since_line_q + 12'h1;
    assign fringe_more = since_fringe_q + 12'h1;
    assign watched = measuring & (|limit);

    always @* begin
        since_line_d = since_line_q;
        if (line | ~watched) begin
            since_line_d = 12'h0;
        end else if (tick & ~no_line_q) begin
            since_line_d = line_more;
        end
    end

    always @* begin
        since_fringe_d = since_fringe_q;
        if (fringe | ~watched) begin
            since_fringe_d = 12'h0;
        end else if (tick & ~no_fringe_q) begin
            since_fringe_d = fringe_more;
        end
    end

    always @* begin
        no_line_d = no_line_q;
        no_fringe_d = no_fringe_q;
        if (clear) begin
            no_line_d = 1'b0;
            no_fringe_d = 1'b0;
        end else if (watched & tick) begin
            if (~line & (limit <= line_more)) begin
                no_line_d = 1'b1;
            end
            if (~fringe & (limit <= fringe_more)) begin
                no_fringe_d = 1'b1;
            end
        end
    end

    assign again = order_known_q
        & ((opening & ~shutting & open_q) | (shutting & ~opening & ~open_q));

    always @* begin
        open_d = open_q;
        order_known_d = order_known_q;
        if (~measuring | (opening & shutting)) begin
            order_known_d = 1'b0;
        end else if (opening | shutting) begin
            order_known_d = 1'b1;
            open_d = opening;
        end
    end

    always @* begin
        wrap_d = wrap_q;
        if (clear) begin
            wrap_d = 1'b0;
        end else if (again & measuring & wrap_watched) begin
            wrap_d = 1'b1;
        end
    end

    always @* begin
        halt_d = halt_q;
        if (stop) begin
            halt_d = 1'b1;
        end else if (clear) begin
            halt_d = 1'b0;
        end
    end

    assign wrong = no_line_q | no_fringe_q | wrap_q;
    assign may_step = enable & ~halt_q & ~stop;
    assign may_correct = enable & ~halt_q & ~stop & ~wrong;
    assign stopped = halt_q | stop;
    assign lines_missing = no_line_q;
    assign fringes_missing = no_fringe_q;
    assign wrapped = wrap_q;
    assign alarm = wrong | halt_q | stop;

    initial begin
        since_line_q = 12'h0;
        since_fringe_q = 12'h0;
        no_line_q = 1'b0;
        no_fringe_q = 1'b0;
        open_q = 1'b0;
        order_known_q = 1'b0;
        wrap_q = 1'b0;
        halt_q = 1'b0;
    end

    always @(posedge clock) begin
        since_line_q <= since_line_d;
        since_fringe_q <= since_fringe_d;
        no_line_q <= no_line_d;
        no_fringe_q <= no_fringe_d;
        open_q <= open_d;
        order_known_q <= order_known_d;
        wrap_q <= wrap_d;
        halt_q <= halt_d;
    end
endmodule

`default_nettype wire
