// Stopped, the windings are off and nothing is asked for; nothing moves without enable, the loop
// corrects with nothing wrong only, a stop is remembered until the panel is off, and settings rest in
// a pass.

module board_shell_proof(
    input clock, input grating, input laser, input start, input correct, input playback,
    input [1:0] calibrate, input manual_step, input manual_forward, input range_x2, input enable,
    input emergency_stop, input grating_b, input laser_b, input grating_index, input laser_index,
    input rx
);
    wire t1, t2, phase_a, phase_b, phase_c, step, direction, zero, fault, measuring, alarm,
        tx;
    board_shell dut(.clock(clock), .grating(grating), .laser(laser), .start(start),
        .correct(correct), .playback(playback), .calibrate(calibrate), .manual_step(manual_step),
        .manual_forward(manual_forward), .range_x2(range_x2), .enable(enable),
        .emergency_stop(emergency_stop), .grating_b(grating_b), .laser_b(laser_b),
        .grating_index(grating_index), .laser_index(laser_index), .rx(rx), .t1(t1), .t2(t2),
        .phase_a(phase_a), .phase_b(phase_b),
        .phase_c(phase_c), .step(step), .direction(direction), .zero(zero), .fault(fault),
        .measuring(measuring), .alarm(alarm), .tx(tx));

    (* hierconn *) wire [3:0] \dut.power_up_q ;
    (* hierconn *) wire \dut.reset ;
    (* hierconn *) wire \dut.start_input_steady ;
    (* hierconn *) wire \dut.correct_input_steady ;
    (* hierconn *) wire \dut.playback_input_steady ;
    (* hierconn *) wire \dut.enable_input_steady ;
    (* hierconn *) wire \dut.range_input_steady ;
    (* hierconn *) wire \dut.manual_step_input_level ;
    (* hierconn *) wire \dut.supervisor_stopped ;
    (* hierconn *) wire \dut.supervisor.clear ;
    (* hierconn *) wire \dut.supervisor.wrap_watched ;
    (* hierconn *) wire \dut.device.master_reset ;
    (* hierconn *) wire \dut.device.correct ;
    (* hierconn *) wire \dut.device.playback ;
    (* hierconn *) wire \dut.device.manual_step ;
    (* hierconn *) wire \dut.device.manual_forward ;
    (* hierconn *) wire \dut.device.range_x2 ;
    (* hierconn *) wire [11:0] \dut.device.divide_a ;
    (* hierconn *) wire [11:0] \dut.device.divide_b ;
    (* hierconn *) wire [11:0] \dut.device.initial_phase ;
    (* hierconn *) wire [15:0] \dut.device.compensation ;
    (* hierconn *) wire \dut.device.compensation_insert ;
    (* hierconn *) wire [23:0] \dut.device.step_period ;
    (* hierconn *) wire \dut.settings_port.range_x2 ;
    (* hierconn *) wire \dut.settings_port.clear ;
    (* hierconn *) wire \dut.settings_port.at_rest ;
    (* hierconn *) wire \dut.receiver.clear ;
    (* hierconn *) wire [1:0] \dut.device.calibrate ;
    (* hierconn *) wire \dut.device.grating ;
    (* hierconn *) wire \dut.device.laser ;
    (* hierconn *) wire \dut.device.start ;
    (* hierconn *) wire \dut.grating_decoder_pulse ;
    (* hierconn *) wire \dut.laser_decoder_pulse ;
    (* hierconn *) wire \dut.grating_decoder.clear ;
    (* hierconn *) wire \dut.laser_decoder.clear ;
    (* hierconn *) wire \dut.grating_decoder_lost ;
    (* hierconn *) wire \dut.laser_decoder_lost ;
    (* hierconn *) wire \dut.grating_gate_open ;
    (* hierconn *) wire \dut.laser_gate_open ;

    // What was, and how long it is since the first clock, to 15.
    reg known = 0;
    reg [3:0] age = 0;
    reg stop_1, stop_2, stop_3, was_reset, was_stopped, was_off, was_lost;
    wire lost = \dut.grating_decoder_lost || \dut.laser_decoder_lost ;
    wire off = !\dut.start_input_steady && !\dut.correct_input_steady
        && !\dut.playback_input_steady ;
    always @(posedge clock) begin
        known <= 1;
        if (age != 15) age <= age + 1;
        {stop_3, stop_2, stop_1} <= {stop_2, stop_1, emergency_stop};
        {was_reset, was_stopped, was_off} <= {\dut.reset , \dut.supervisor_stopped , off};
        was_lost <= lost;
    end

    // The reset ends within 15 clocks of any power-up, and does not come back.
    always @* begin
        assert (\dut.power_up_q >= age);
        assert (\dut.device.master_reset == (\dut.power_up_q != 15));
        if (known && !was_reset) assert (!\dut.device.master_reset );
    end

    // With a second signal the device counts what the decoders let through; a pass waits for both
    // indices, and what is owed is forgotten without one.
    always @* begin
        assert (\dut.device.grating == \dut.grating_decoder_pulse );
        assert (\dut.device.laser == \dut.laser_decoder_pulse );
        assert (\dut.device.start == (\dut.grating_gate_open && \dut.laser_gate_open ));
        assert (\dut.grating_decoder.clear == (\dut.reset || !\dut.start_input_steady ));
        assert (\dut.laser_decoder.clear == (\dut.reset || !\dut.start_input_steady ));
        if (lost) assert (\dut.supervisor_stopped );
    end

    // What may ask the device for steps.
    wire may_step = \dut.enable_input_steady && !\dut.supervisor_stopped ;
    always @* begin
        assert (\dut.device.correct == (\dut.correct_input_steady && may_step && !alarm));
        assert (\dut.device.playback == (\dut.playback_input_steady && may_step));
        assert (\dut.device.manual_step == (\dut.manual_step_input_level && may_step));
        assert (\dut.device.manual_forward == manual_forward);
        assert (\dut.device.calibrate == calibrate);
        assert (\dut.device.range_x2 == (\dut.settings_port.range_x2 || \dut.range_input_steady ));
    end

    // Settings: those of the bitstream after a reset, and the same as long as the panel is not off.
    wire [76:0] settings = { \dut.device.divide_a , \dut.device.divide_b ,
        \dut.device.initial_phase , \dut.device.compensation , \dut.device.compensation_insert ,
        \dut.device.step_period };
    reg [76:0] settings_before;
    reg was_measuring;
    always @(posedge clock) begin
        settings_before <= settings;
        was_measuring <= measuring;
    end
    always @* begin
        assert (\dut.settings_port.clear == \dut.reset );
        assert (\dut.receiver.clear == \dut.reset );
        assert (\dut.settings_port.at_rest == (off && !measuring));
        if (known && was_reset)
            assert (settings == {12'h4, 12'h3, 12'h2, 16'h1, 1'b1, 24'd200}
                && !\dut.settings_port.range_x2 );
        if (known && !was_reset && (!was_off || was_measuring))
            assert (settings == settings_before);
    end

    // Windings: one or two have current, none when stopped.
    always @* if (\dut.supervisor_stopped ) assert ({phase_a, phase_b, phase_c} == 0);
    always @* if (known && !\dut.supervisor_stopped ) begin
        assert ({phase_a, phase_b, phase_c} != 0);
        assert ({phase_a, phase_b, phase_c} != 7);
    end

    // A stop is there two clocks after the contact opened, and until the panel is off.
    reg [1:0] old = 0;
    always @(posedge clock) if (old != 3) old <= old + 1;
    always @* begin
        if (old >= 2 && stop_2) assert (\dut.supervisor_stopped );
        if (\dut.supervisor_stopped ) assert (alarm);
        if (known && was_stopped && !was_off && !was_reset) assert (\dut.supervisor_stopped );
        if (old == 3 && !stop_2 && !stop_3 && !lost && !was_lost && (was_off || was_reset))
            assert (!\dut.supervisor_stopped );
        assert (\dut.supervisor.wrap_watched == \dut.correct_input_steady );
        assert (t2 == !t1);
    end
    always @* cover (age == 15 && \dut.supervisor_stopped && !stop_2);
    always @* cover (known && \dut.device.correct && measuring);
endmodule
