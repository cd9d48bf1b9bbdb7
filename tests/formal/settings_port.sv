// Settings are the bitstream's until a whole request at rest gives others; wheels can show them, and
// they change at no other time. An answer has them, begins between two frames of the telemetry, and
// nothing of the telemetry gets into it.

module settings_port_proof(
    input clock, input clear, input at_rest, input received, input [7:0] received_byte,
    input telemetry_send, input [7:0] telemetry_byte, input ready, input [23:0] tick_period,
    input [11:0] built_divide_a, input [11:0] built_divide_b, input built_range_x2,
    input [11:0] built_initial_phase, input [15:0] built_compensation,
    input built_compensation_insert, input [23:0] built_step_period
);
    wire [11:0] divide_a, divide_b, initial_phase;
    wire [15:0] compensation;
    wire [23:0] step_period;
    wire range_x2, compensation_insert, telemetry_ready, send;
    wire [7:0] data;
    settings_port dut(.clock(clock), .clear(clear), .at_rest(at_rest), .received(received),
        .received_byte(received_byte), .telemetry_send(telemetry_send),
        .telemetry_byte(telemetry_byte), .ready(ready), .tick_period(tick_period),
        .built_divide_a(built_divide_a), .built_divide_b(built_divide_b),
        .built_range_x2(built_range_x2), .built_initial_phase(built_initial_phase),
        .built_compensation(built_compensation),
        .built_compensation_insert(built_compensation_insert),
        .built_step_period(built_step_period), .divide_a(divide_a), .divide_b(divide_b),
        .range_x2(range_x2), .initial_phase(initial_phase), .compensation(compensation),
        .compensation_insert(compensation_insert), .step_period(step_period),
        .telemetry_ready(telemetry_ready), .send(send), .data(data));
    (* hierconn *) wire [39:0] \dut.low_q ;
    (* hierconn *) wire [43:0] \dut.high_q ;
    (* hierconn *) wire [4:0] \dut.place_q ;
    (* hierconn *) wire [2:0] \dut.turns_q ;
    (* hierconn *) wire \dut.pending_q ;
    (* hierconn *) wire \dut.answering_q ;
    (* hierconn *) wire \dut.telemetry_busy_q ;
    (* hierconn *) wire [15:0] \dut.remainder_check ;
    (* hierconn *) wire \dut.remainder_clear ;
    (* hierconn *) wire \dut.turning ;
    (* hierconn *) wire \dut.passing ;

    wire [77:0] set = {compensation_insert, range_x2, step_period, compensation, initial_phase,
        divide_b, divide_a};
    wire [77:0] built = {built_compensation_insert, built_range_x2, built_step_period,
        built_compensation, built_initial_phase, built_divide_b, built_divide_a};
    wire [3:0] kind = \dut.low_q [3:0];
    wire [79:0] asked = { \dut.high_q , \dut.low_q [39:4]};

    // What wheels show.
    function is_digit(input [3:0] d);
        is_digit = d <= 9;
    endfunction
    function are_shown(input [79:0] s);
        are_shown = is_digit(s[3:0]) && is_digit(s[7:4]) && is_digit(s[11:8])
            && is_digit(s[15:12]) && is_digit(s[19:16]) && is_digit(s[23:20])
            && is_digit(s[27:24]) && is_digit(s[31:28]) && is_digit(s[35:32])
            && is_digit(s[39:36]) && is_digit(s[43:40]) && is_digit(s[47:44])
            && is_digit(s[51:48]) && s[11:0] != 0 && s[23:12] != 0 && s[75:52] >= 128
            && s[79:78] == 0;
    endfunction

    // The bitstream is what it is, and can be dialled; the telemetry sends when it may.
    reg running = 0;
    reg [77:0] built_before;
    always @(posedge clock) begin
        running <= 1;
        built_before <= built;
    end
    always @* if (running) assume (built == built_before);
    always @* assume (are_shown({2'b00, built}));
    always @* if (telemetry_send) assume (telemetry_ready);

    // What was a clock ago.
    reg known = 0;
    reg was_cleared, was_whole, was_at_rest, was_claimed, was_busy, was_telling, was_listening;
    reg [77:0] set_before;
    reg [79:0] asked_before;
    reg [3:0] kind_before;
    reg [23:0] tick_before;
    reg between;
    wire listening = !\dut.turning && !\dut.pending_q && !\dut.answering_q ;
    always @(posedge clock) begin
        if (clear) known <= 1;
        was_cleared <= clear;
        was_listening <= listening;
        was_whole <= received && received_byte == 0 && \dut.place_q == 26
            && \dut.remainder_check == 16'h0f47 && listening;
        was_at_rest <= at_rest;
        was_busy <= \dut.telemetry_busy_q ;
        was_telling <= telemetry_send;
        was_claimed <= \dut.pending_q && !\dut.turning && !\dut.telemetry_busy_q
            && !telemetry_send;
        set_before <= set;
        asked_before <= asked;
        kind_before <= kind;
        tick_before <= tick_period;
        between <= clear || (telemetry_send ? telemetry_byte == 0 : between);
    end
    wire writes = was_whole && was_at_rest && kind_before == 3 && are_shown(asked_before);

    // Settings.
    always @* if (known && was_cleared) assert (set == built);
    always @* if (known && !was_cleared) begin
        if (writes) assert ({2'b00, set} == asked_before);
        if (!writes) assert (set == set_before);
    end
    always @* if (known) assert (are_shown({2'b00, set}));

    // A request is answered when it came over whole, and by what became of it.
    always @* if (known && !was_cleared && was_whole) begin
        assert ( \dut.pending_q == (kind_before >= 1 && kind_before <= 3));
        if (kind_before == 3)
            assert (kind == (!was_at_rest ? 4 : are_shown(asked_before) ? 3 : 5));
        else if ( \dut.pending_q ) assert (kind == kind_before);
    end
    always @* if (known && \dut.pending_q ) assert (kind >= 1 && kind <= 5);
    always @* if (known && !was_cleared && was_listening && !was_whole) assert (!\dut.pending_q );
    always @* if (known && !was_cleared && was_claimed) begin
        assert ( \dut.answering_q && !\dut.pending_q && kind == kind_before);
        if (kind != 1) assert (asked == {2'b00, set_before});
        if (kind == 1) assert (asked == {4'h0, tick_before, 52'h17430});
    end

    // The line.
    always @* begin
        if (!\dut.answering_q )
            assert (send == telemetry_send && data == telemetry_byte && telemetry_ready == ready);
        if ( \dut.answering_q ) assert (!telemetry_ready);
        if ( \dut.answering_q && send) begin
            assert (ready && !\dut.turning );
            if ( \dut.place_q == 0) assert (data == 8'h1a);
            else if ( \dut.place_q == 26) assert (data == 8'h00);
            else if ( \dut.place_q <= 21) assert (data == {4'h3, kind});
            else assert (data == {4'h3, \dut.remainder_check [3:0]});
        end
    end
    always @* if (known) begin
        assert ( \dut.telemetry_busy_q == !between);
        if ( \dut.answering_q ) assert (between && !\dut.pending_q );
        assert ( \dut.place_q <= 26 && \dut.turns_q <= 4);
        if ( \dut.turning ) assert ( \dut.place_q >= 1 && \dut.place_q <= 25);
        if ( \dut.pending_q ) assert (!\dut.turning );
    end
    // Bits pass the check: a digit's that comes, or those that go.
    always @* if ( \dut.turning ) begin
        if (!\dut.answering_q && \dut.turns_q <= 4)
            assert ( \dut.passing == received_byte[4 - \dut.turns_q ]);
        if ( \dut.answering_q && \dut.place_q <= 21) assert ( \dut.passing == kind[0]);
        if ( \dut.answering_q && \dut.place_q > 21)
            assert ( \dut.passing != \dut.remainder_check [0]);
    end
    always @* if ( \dut.place_q == 0) assert ( \dut.remainder_clear );
    always @* if (listening && received && received_byte == 8'h1a) assert ( \dut.remainder_clear );

    // Frames grow by digits, end with zero, and anything else ends them unheard.
    reg [4:0] place_before;
    reg digit_before, begin_before, other_before, sent_before, answering_before, turned_before;
    reg coming_before;
    reg [2:0] turns_before;
    reg [83:0] digits_before;
    wire [83:0] digits = { \dut.high_q , \dut.low_q };
    always @(posedge clock) begin
        turns_before <= \dut.turns_q ;
        coming_before <= received_byte[4 - \dut.turns_q ];
        digits_before <= digits;
        place_before <= \dut.place_q ;
        answering_before <= \dut.answering_q ;
        turned_before <= \dut.turns_q == 1;
        begin_before <= listening && received && received_byte == 8'h1a;
        digit_before <= listening && received && received_byte[7:4] == 3 && \dut.place_q != 0
            && \dut.place_q != 26;
        other_before <= listening && received && received_byte != 8'h1a
            && !(received_byte[7:4] == 3 && \dut.place_q != 0 && \dut.place_q != 26);
        sent_before <= \dut.answering_q && send;
    end
    always @* if (known && was_cleared)
        assert ( \dut.place_q == 0 && \dut.turns_q == 0 && listening && between);
    always @* if (known && !was_cleared) begin
        if (other_before) assert ( \dut.place_q == 0);
        if (turns_before != 0) begin
            assert ( \dut.turns_q == turns_before - 3'd1);
            if (place_before <= 21) assert (digits == {coming_before, digits_before[83:1]});
            else assert (digits == digits_before);
        end
        if (begin_before) assert ( \dut.place_q == 1);
        if (digit_before) assert ( \dut.turns_q == 4 && \dut.place_q == place_before);
        if (turned_before) assert ( \dut.place_q == place_before + 5'd1);
        if (sent_before && place_before == 0) assert ( \dut.place_q == 1);
        if (sent_before && place_before == 26)
            assert ( \dut.place_q == 0 && !\dut.answering_q );
        if (sent_before && place_before != 0 && place_before != 26)
            assert ( \dut.turns_q == 4 && \dut.answering_q );
        if (answering_before && !(sent_before && place_before == 26))
            assert ( \dut.answering_q );
    end

    always @* cover (known && was_whole && set != set_before);
    always @* cover (known && \dut.answering_q && \dut.place_q == 26 && send);
endmodule
