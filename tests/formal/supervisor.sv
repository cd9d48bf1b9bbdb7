// No correction while something is missing, wrapped or stopped; no step without enable; what was
// wrong stays known until clear; the watchdogs are silent when off.

module supervisor_proof(
    input clock, input clear, input tick, input [11:0] limit, input wrap_watched, input measuring,
    input line, input fringe, input opening, input shutting, input enable, input stop
);
    wire may_correct, may_step, stopped, lines_missing, fringes_missing, wrapped, alarm;
    supervisor dut(.clock(clock), .clear(clear), .tick(tick), .limit(limit),
        .wrap_watched(wrap_watched), .measuring(measuring), .line(line), .fringe(fringe),
        .opening(opening), .shutting(shutting), .enable(enable), .stop(stop),
        .may_correct(may_correct), .may_step(may_step), .stopped(stopped),
        .lines_missing(lines_missing), .fringes_missing(fringes_missing), .wrapped(wrapped),
        .alarm(alarm));

    // Ticks since the last line and fringe, while they are watched; whose turn it is.
    wire watched = measuring && limit != 0;
    reg known = 0;
    reg [11:0] line_ticks, fringe_ticks;
    reg [1:0] last;
    reg was_stop;
    reg line_late, fringe_late, twice;
    always @(posedge clock) begin
        if (clear && !measuring) known <= 1;
        if (line || !watched) line_ticks <= 0;
        else if (tick && !lines_missing) line_ticks <= line_ticks + 1;
        if (fringe || !watched) fringe_ticks <= 0;
        else if (tick && !fringes_missing) fringe_ticks <= fringe_ticks + 1;
        if (!measuring || (opening && shutting)) last <= 0;
        else if (opening) last <= 1;
        else if (shutting) last <= 2;
        line_late <= !clear && (lines_missing
            || (watched && tick && !line && line_ticks + 12'd1 >= limit));
        fringe_late <= !clear && (fringes_missing
            || (watched && tick && !fringe && fringe_ticks + 12'd1 >= limit));
        twice <= !clear && (wrapped || (measuring && wrap_watched && opening != shutting
            && last == (opening ? 1 : 2)));
        was_stop <= stop || (!clear && (was_stop && known));
    end

    always @* begin
        if (alarm) assert (!may_correct);
        if (!enable || stop) assert (!may_step);
        if (may_correct) assert (may_step);
        if (stop) assert (stopped && alarm);
        if (stopped) assert (!may_step);
        if (enable && !stopped) assert (may_step);
        if (enable && !alarm) assert (may_correct);
        assert (alarm == (stopped || lines_missing || fringes_missing || wrapped));
    end
    always @* if (known) begin
        assert (lines_missing == line_late);
        assert (fringes_missing == fringe_late);
        assert (wrapped == twice);
        assert (stopped == (stop || was_stop));
    end

    // What the proof of these needs to know of the registers.
    (* hierconn *) wire [11:0] \dut.since_line_q ;
    (* hierconn *) wire [11:0] \dut.since_fringe_q ;
    (* hierconn *) wire \dut.order_known_q ;
    (* hierconn *) wire \dut.open_q ;
    always @* if (known) begin
        assert (\dut.since_line_q == line_ticks);
        assert (\dut.since_fringe_q == fringe_ticks);
        assert (\dut.order_known_q == (last != 0));
        if (last != 0) assert (\dut.open_q == (last == 1));
        assert (last != 3);
    end

    always @* cover (known && lines_missing && !fringes_missing);
    always @* cover (known && wrapped && !stopped);
    always @* cover (known && stopped && !stop);
endmodule
