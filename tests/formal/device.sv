// Steps are never closer than the step clock; the count is the net steps; the meter rests until
// the phase is selected; ring legal; direction changes at a decision only.

module device_proof(
    input clock, input master_reset, input grating, input laser, input start, input correct,
    input playback, input [1:0] calibrate, input manual_step, input manual_forward,
    input [11:0] divide_a, input [11:0] divide_b, input range_x2, input [11:0] initial_phase,
    input [15:0] compensation, input compensation_insert, input [23:0] step_period
);
    wire t1, t2, standard, cp1, cp2, q, q_bar, step, forward, reverse, phase_a, phase_b, phase_c;
    wire [11:0] count;
    wire count_forward, zero, fault, measuring, grating_divided, laser_divided;
    device dut(.clock(clock), .master_reset(master_reset), .grating(grating), .laser(laser),
        .start(start), .correct(correct), .playback(playback), .calibrate(calibrate),
        .manual_step(manual_step), .manual_forward(manual_forward), .divide_a(divide_a),
        .divide_b(divide_b), .range_x2(range_x2), .initial_phase(initial_phase),
        .compensation(compensation), .compensation_insert(compensation_insert),
        .step_period(step_period), .t1(t1), .t2(t2), .standard(standard), .cp1(cp1), .cp2(cp2),
        .q(q), .q_bar(q_bar), .step(step), .forward(forward), .reverse(reverse),
        .phase_a(phase_a), .phase_b(phase_b), .phase_c(phase_c), .count(count),
        .count_forward(count_forward), .zero(zero), .fault(fault), .measuring(measuring),
        .grating_divided(grating_divided), .laser_divided(laser_divided));

    (* hierconn *) wire [23:0] \dut.step_clock.left_q ;
    (* hierconn *) wire \dut.correct_input_level ;
    (* hierconn *) wire \dut.playback_input_level ;
    (* hierconn *) wire \dut.discriminator_decided ;
    (* hierconn *) wire \dut.phase_meter_meter ;
    (* hierconn *) wire \dut.start_input_level ;

    // The wheel of the step clock rests between resets.
    reg [23:0] wheel;
    reg known = 0;
    always @* if (known && !master_reset) assume (step_period == wheel);

    reg signed [13:0] position;
    reg [23:0] since;
    reg was_q, was_cp1, was_cp2, was_measuring, was_reset;
    wire signed [13:0] magnitude = $signed({2'b00, count});
    always @(posedge clock) begin
        wheel <= step_period;
        if (master_reset) known <= 1;
        {was_q, was_cp1, was_cp2, was_measuring, was_reset} <= {q, cp1, cp2, measuring, master_reset};
        if (master_reset) position <= 0;
        else if (step) position <= forward ? position + 14'sd1 : position - 14'sd1;
        if (master_reset) since <= step_period;
        else if (step) since <= 1;
        else if (since < step_period) since <= since + 1;
    end

    always @* begin
        assert (t2 == !t1);
        assert (reverse == !forward);
        assert (q_bar == !q);
        assert (cp1 || cp2);
        if (master_reset) assert (!step);
    end
    always @* if (known && !master_reset) begin
        // The step clock has run since the last step at least.
        if (step_period != 0) assert ({1'b0, since} + \dut.step_clock.left_q > step_period);
        else assert ( \dut.step_clock.left_q == 0);
        assert (since <= step_period);
        if (step) assert (since == step_period);
        assert (position == (count_forward ? magnitude : -magnitude));
        assert (zero == (count == 0));
        assert (!(phase_a == phase_b && phase_b == phase_c));
        if (was_reset) assert (!q && count == 0 && !fault);
        else if (was_cp1 && was_cp2) assert (q == was_q);
        if (step && \dut.playback_input_level ) assert (!zero && forward == !count_forward);
        if (step && !\dut.playback_input_level && \dut.correct_input_level )
            assert (measuring && \dut.discriminator_decided && forward == q);
        if (!was_measuring) assert (! \dut.phase_meter_meter );
        if (!measuring) assert (cp1 && cp2);
    end

    always @* cover (known && measuring);
    always @* cover (known && step && count == 2);
endmodule
