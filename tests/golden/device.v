// SPDX-License-Identifier: MIT OR Apache-2.0
// device: The whole measuring and correcting logic (figs. 6, 14)

`default_nettype none

module device (
    // clock: FPGA clock, rising edge
    input  wire         clock,
    // master_reset: everything to its start; synchronous, four clocks or more
    input  wire         master_reset,
    // grating: grating lines, asynchronous, rising edges count
    input  wire         grating,
    // laser: interference fringes, likewise
    input  wire         laser,
    // start: level: select the initial phase, then measure
    input  wire         start,
    // correct: level: correct, else only measure
    input  wire         correct,
    // playback: level: steps back to zero ("reset" switch, fig. 17)
    input  wire         playback,
    // calibrate: 0 off, 1 180°, 2 90°, 3 45°
    input  wire [1:0]   calibrate,
    // manual_step: rising edge: one step
    input  wire         manual_step,
    // manual_forward: its direction
    input  wire         manual_forward,
    // divide_a: A, three BCD digits
    input  wire [11:0]  divide_a,
    // divide_b: B, three BCD digits
    input  wire [11:0]  divide_b,
    // range_x2: ×2 instead of ×1
    input  wire         range_x2,
    // initial_phase: m, three BCD digits
    input  wire [11:0]  initial_phase,
    // compensation: F/1000, four BCD digits; 0000 is off
    input  wire [15:0]  compensation,
    // compensation_insert: insert instead of block
    input  wire         compensation_insert,
    // step_period: clocks from step to step; 0 stops the step clock
    input  wire [23:0]  step_period,
    // t1: meter and complement, or the calibration
    output wire         t1,
    // t2: meter and complement, or the calibration
    output wire         t2,
    // standard: standard square wave
    output wire         standard,
    // cp1: clocks of the discriminator's flip-flop, active low
    output wire         cp1,
    // cp2: clocks of the discriminator's flip-flop, active low
    output wire         cp2,
    // q: that flip-flop: the loop wants forward, reverse
    output wire         q,
    // q_bar: that flip-flop: the loop wants forward, reverse
    output wire         q_bar,
    // step: high for one clock: a step is taken
    output wire         step,
    // forward: direction the motor is driven in, and its complement
    output wire         forward,
    // reverse: direction the motor is driven in, and its complement
    output wire         reverse,
    // phase_a: drives of the three windings
    output wire         phase_a,
    // phase_b: drives of the three windings
    output wire         phase_b,
    // phase_c: drives of the three windings
    output wire         phase_c,
    // count: steps away from zero
    output wire [11:0]  count,
    // count_forward: on which side
    output wire         count_forward,
    // zero: the count is zero
    output wire         zero,
    // fault: a step was refused at 4095
    output wire         fault,
    // measuring: the initial phase is selected
    output wire         measuring,
    // grating_divided: high for one clock: sets the meter, a comparison starts
    output wire         grating_divided,
    // laser_divided: high for one clock: clears the meter
    output wire         laser_divided
);

    wire rest;
    reg [1:0] calibration;
    wire no_middle;
    wire grating_input_rising;
    wire laser_input_rising;
    wire start_input_level;
    wire correct_input_level;
    wire playback_input_level;
    wire calibrate_low_input_level;
    wire calibrate_high_input_level;
    wire manual_step_input_rising;
    wire manual_forward_input_level;
    wire compensator_pulse;
    wire selector_open;
    wire selector_line;
    wire divider_a_divided;
    wire divider_a_half;
    wire divider_b_divided;
    wire divider_b_half;
    wire grating_range_pulse;
    wire laser_range_pulse;
    wire standard_wave_standard;
    wire phase_meter_hold;
    wire phase_meter_meter;
    wire calibrator_t1;
    wire calibrator_t2;
    wire discriminator_hold;
    wire discriminator_cp1;
    wire discriminator_cp2;
    wire discriminator_q;
    wire discriminator_q_bar;
    wire discriminator_decided;
    wire step_clock_tick;
    wire step_selector_correcting;
    wire step_selector_manual_enable;
    wire step_selector_request;
    wire step_selector_forward;
    wire reset_counter_step;
    wire reset_counter_drive_forward;
    wire [11:0] reset_counter_count;
    wire reset_counter_count_forward;
    wire reset_counter_zero;
    wire reset_counter_fault;
    wire ring_phase_a;
    wire ring_phase_b;
    wire ring_phase_c;

    input_synchroniser grating_input (
        .clock(clock),
        .pin(grating),
        .rising(grating_input_rising)
    );

    input_synchroniser laser_input (
        .clock(clock),
        .pin(laser),
        .rising(laser_input_rising)
    );

    level_synchroniser start_input (
        .clock(clock),
        .pin(start),
        .level(start_input_level)
    );

    level_synchroniser correct_input (
        .clock(clock),
        .pin(correct),
        .level(correct_input_level)
    );

    level_synchroniser playback_input (
        .clock(clock),
        .pin(playback),
        .level(playback_input_level)
    );

    level_synchroniser calibrate_low_input (
        .clock(clock),
        .pin(calibrate[0]),
        .level(calibrate_low_input_level)
    );

    level_synchroniser calibrate_high_input (
        .clock(clock),
        .pin(calibrate[1]),
        .level(calibrate_high_input_level)
    );

    input_synchroniser manual_step_input (
        .clock(clock),
        .pin(manual_step),
        .rising(manual_step_input_rising)
    );

    level_synchroniser manual_forward_input (
        .clock(clock),
        .pin(manual_forward),
        .level(manual_forward_input_level)
    );

    cumulative_compensator compensator (
        .clock(clock),
        .clear(rest),
        .laser(laser_input_rising),
        .preset(compensation),
        .insert(compensation_insert),
        .pulse(compensator_pulse)
    );

    initial_phase_selector selector (
        .clock(clock),
        .clear(rest),
        .laser(compensator_pulse),
        .grating(grating_input_rising),
        .preset(initial_phase),
        .open(selector_open),
        .line(selector_line)
    );

    programmable_divider divider_a (
        .clock(clock),
        .clear(rest),
        .pulse(selector_line),
        .preset(divide_a),
        .divided(divider_a_divided),
        .half(divider_a_half)
    );

    programmable_divider divider_b (
        .clock(clock),
        .clear(rest),
        .pulse(compensator_pulse),
        .preset(divide_b),
        .divided(divider_b_divided),
        .half(divider_b_half)
    );

    range_stage grating_range (
        .clock(clock),
        .clear(rest),
        .divided(divider_a_divided),
        .range_x2(range_x2),
        .pulse(grating_range_pulse)
    );

    range_stage laser_range (
        .clock(clock),
        .clear(rest),
        .divided(divider_b_divided),
        .range_x2(range_x2),
        .pulse(laser_range_pulse)
    );

    standard_wave standard_wave (
        .clock(clock),
        .clear(rest),
        .divided(divider_a_divided),
        .start(grating_range_pulse),
        .half(divider_a_half),
        .range_x2(range_x2),
        .standard(standard_wave_standard)
    );

    phase_meter phase_meter (
        .clock(clock),
        .hold(phase_meter_hold),
        .grating(grating_range_pulse),
        .laser(laser_range_pulse),
        .meter(phase_meter_meter)
    );

    calibrator calibrator (
        .clock(clock),
        .clear(master_reset),
        .line(grating_input_rising),
        .meter(phase_meter_meter),
        .calibrate(calibration),
        .t1(calibrator_t1),
        .t2(calibrator_t2)
    );

    direction_discriminator discriminator (
        .clock(clock),
        .clear(master_reset),
        .hold(discriminator_hold),
        .meter(phase_meter_meter),
        .standard(standard_wave_standard),
        .cp1(discriminator_cp1),
        .cp2(discriminator_cp2),
        .q(discriminator_q),
        .q_bar(discriminator_q_bar),
        .decided(discriminator_decided)
    );

    step_clock step_clock (
        .clock(clock),
        .clear(master_reset),
        .period(step_period),
        .tick(step_clock_tick)
    );

    step_selector step_selector (
        .clock(clock),
        .clear(master_reset),
        .tick(step_clock_tick),
        .correcting(step_selector_correcting),
        .automatic_forward(discriminator_q),
        .manual_enable(step_selector_manual_enable),
        .manual_step(manual_step_input_rising),
        .manual_forward(manual_forward_input_level),
        .playback(playback_input_level),
        .request(step_selector_request),
        .forward(step_selector_forward)
    );

    reset_counter reset_counter (
        .clock(clock),
        .clear(master_reset),
        .request(step_selector_request),
        .forward(step_selector_forward),
        .playback(playback_input_level),
        .step(reset_counter_step),
        .drive_forward(reset_counter_drive_forward),
        .count(reset_counter_count),
        .count_forward(reset_counter_count_forward),
        .zero(reset_counter_zero),
        .fault(reset_counter_fault)
    );

    ring_distributor ring (
        .clock(clock),
        .clear(master_reset),
        .step(reset_counter_step),
        .forward(reset_counter_drive_forward),
        .phase_a(ring_phase_a),
        .phase_b(ring_phase_b),
        .phase_c(ring_phase_c)
    );

    assign rest = master_reset | ~start_input_level;
    assign phase_meter_hold = rest | ~selector_open;

    always @* begin
        if (calibrate_high_input_level & calibrate_low_input_level) begin
            calibration = 2'd3;
        end else if (calibrate_high_input_level) begin
            calibration = 2'd2;
        end else if (calibrate_low_input_level) begin
            calibration = 2'd1;
        end else begin
            calibration = 2'd0;
        end
    end

    assign no_middle = (divide_a == 12'h1) & ~range_x2;
    assign discriminator_hold = rest | ~selector_open | no_middle;
    assign step_selector_correcting = correct_input_level & selector_open & discriminator_decided;
    assign step_selector_manual_enable = ~correct_input_level;
    assign t1 = calibrator_t1;
    assign t2 = calibrator_t2;
    assign standard = standard_wave_standard;
    assign cp1 = discriminator_cp1;
    assign cp2 = discriminator_cp2;
    assign q = discriminator_q;
    assign q_bar = discriminator_q_bar;
    assign step = reset_counter_step;
    assign forward = reset_counter_drive_forward;
    assign reverse = ~reset_counter_drive_forward;
    assign phase_a = ring_phase_a;
    assign phase_b = ring_phase_b;
    assign phase_c = ring_phase_c;
    assign count = reset_counter_count;
    assign count_forward = reset_counter_count_forward;
    assign zero = reset_counter_zero;
    assign fault = reset_counter_fault;
    assign measuring = selector_open;
    assign grating_divided = grating_range_pulse;
    assign laser_divided = laser_range_pulse;

    // Without a reader here; named so that linters know it is meant.
    wire unused_bits = &{1'b0, divider_b_half};
endmodule

`default_nettype wire
