// SPDX-License-Identifier: MIT OR Apache-2.0
// board_shell: The device with its wheels set, and the pins a builder wires

`default_nettype none

module board_shell (
    // clock: the board's oscillator
    input  wire         clock,
    // grating: shaped grating signal, one rising edge a line
    input  wire         grating,
    // laser: shaped interferometer signal, one rising edge a fringe
    input  wire         laser,
    // start: switch: select the initial phase, then measure
    input  wire         start,
    // correct: switch: correct, else only measure
    input  wire         correct,
    // playback: switch "reset": steps back to zero
    input  wire         playback,
    // calibrate: switch: off, 180°, 90°, 45°
    input  wire [1:0]   calibrate,
    // manual_step: push button: one step
    input  wire         manual_step,
    // manual_forward: switch: its direction
    input  wire         manual_forward,
    // range_x2: * switch: ×2 instead of ×1
    input  wire         range_x2,
    // enable: * switch: steps are allowed
    input  wire         enable,
    // emergency_stop: * contact to ground that opens: high stops all steps
    input  wire         emergency_stop,
    // grating_b: * second signal of the grating, a quarter of a line late
    input  wire         grating_b,
    // laser_b: * second signal of the laser, a quarter of a fringe late
    input  wire         laser_b,
    // grating_index: * index of the grating: a pass begins there
    input  wire         grating_index,
    // laser_index: * index of a scale in the laser's place, likewise
    input  wire         laser_index,
    // rx: * serial port: settings from the computer
    input  wire         rx,
    // t1: RC low-pass each, the difference to the recorder
    output wire         t1,
    // t2: RC low-pass each, the difference to the recorder
    output wire         t2,
    // phase_a: power stage of the three windings
    output wire         phase_a,
    // phase_b: power stage of the three windings
    output wire         phase_b,
    // phase_c: power stage of the three windings
    output wire         phase_c,
    // step: … or a bought stepper driver
    output wire         step,
    // direction: … or a bought stepper driver
    output wire         direction,
    // zero: lamp: the motor stands where it began
    output wire         zero,
    // fault: lamp: out of steps, 4095 from zero
    output wire         fault,
    // measuring: lamp: the initial phase is selected
    output wire         measuring,
    // alarm: lamp: a signal is missing, the meter wrapped, or a stop
    output wire         alarm,
    // tx: serial port: a frame for every comparison
    output wire         tx
);

    wire [3:0] power_up_next;
    wire reset;
    wire idle;
    wire at_rest;
    wire every_clock;
    wire nothing;
    localparam [11:0] divide_a = 12'h4;
    localparam [11:0] divide_b = 12'h3;
    localparam [11:0] initial_phase = 12'h2;
    localparam [15:0] compensation = 16'h1;
    localparam compensation_insert = 1'b1;
    localparam [23:0] step_period = 24'hc8;
    localparam range_set = 1'b0;
    localparam range_wired = 1'b1;
    localparam enable_wired = 1'b1;
    localparam grating_b_wired = 1'b1;
    localparam laser_b_wired = 1'b1;
    localparam grating_index_wired = 1'b1;
    localparam laser_index_wired = 1'b1;
    localparam [3:0] glitch_clocks = 4'd2;
    localparam [3:0] debounce_ticks = 4'd3;
    localparam [23:0] tick_period = 24'h5;
    localparam [11:0] watchdog_ticks = 12'h28;
    localparam active_low = 1'b0;
    localparam [11:0] bit_clocks = 12'h2;
    localparam [1:0] calibrate_inverted = 2'd0;
    reg device_grating;
    reg device_laser;
    wire device_start;
    wire device_correct;
    wire device_playback;
    wire [1:0] device_calibrate;
    wire device_manual_step;
    wire device_manual_forward;
    wire device_range_x2;
    wire device_t1;
    wire device_t2;
    wire device_standard;
    wire device_cp1;
    wire device_cp2;
    wire device_q;
    wire device_q_bar;
    wire device_step;
    wire device_forward;
    wire device_reverse;
    wire device_phase_a;
    wire device_phase_b;
    wire device_phase_c;
    wire [11:0] device_count;
    wire device_count_forward;
    wire device_zero;
    wire device_fault;
    wire device_measuring;
    wire device_grating_divided;
    wire device_laser_divided;
    wire step_driver_step_pin;
    wire step_driver_direction_pin;
    wire milliseconds_tick;
    wire supervisor_clear;
    wire supervisor_wrap_watched;
    wire supervisor_enable;
    wire supervisor_stop;
    wire supervisor_may_correct;
    wire supervisor_may_step;
    wire supervisor_stopped;
    wire supervisor_lines_missing;
    wire supervisor_fringes_missing;
    wire supervisor_wrapped;
    wire supervisor_alarm;
    wire telemetry_send;
    wire [7:0] telemetry_data;
    wire transmitter_line;
    wire transmitter_ready;
    wire receiver_received;
    wire [7:0] receiver_data;
    wire settings_port_at_rest;
    wire [11:0] settings_port_divide_a;
    wire [11:0] settings_port_divide_b;
    wire settings_port_range_x2;
    wire [11:0] settings_port_initial_phase;
    wire [15:0] settings_port_compensation;
    wire settings_port_compensation_insert;
    wire [23:0] settings_port_step_period;
    wire settings_port_telemetry_ready;
    wire settings_port_send;
    wire [7:0] settings_port_data;
    wire grating_input_level;
    wire grating_input_steady;
    wire laser_input_level;
    wire laser_input_steady;
    wire start_input_level;
    wire start_input_steady;
    wire correct_input_level;
    wire correct_input_steady;
    wire playback_input_level;
    wire playback_input_steady;
    wire manual_step_input_level;
    wire manual_step_input_steady;
    wire range_input_level;
    wire range_input_steady;
    wire enable_input_level;
    wire enable_input_steady;
    wire stop_input_level;
    wire grating_b_input_level;
    wire grating_b_input_steady;
    wire laser_b_input_level;
    wire laser_b_input_steady;
    wire grating_index_input_level;
    wire grating_index_input_steady;
    wire laser_index_input_level;
    wire laser_index_input_steady;
    wire grating_decoder_pulse;
    wire [15:0] grating_decoder_behind;
    wire grating_decoder_lost;
    wire laser_decoder_pulse;
    wire [15:0] laser_decoder_behind;
    wire laser_decoder_lost;
    wire grating_gate_open;
    wire laser_gate_open;
    wire lines_rising;
    wire fringes_rising;
    reg [3:0] power_up_d;
    reg [3:0] power_up_q;

    device device (
        .clock(clock),
        .master_reset(reset),
        .grating(device_grating),
        .laser(device_laser),
        .start(device_start),
        .correct(device_correct),
        .playback(device_playback),
        .calibrate(device_calibrate),
        .manual_step(device_manual_step),
        .manual_forward(device_manual_forward),
        .divide_a(settings_port_divide_a),
        .divide_b(settings_port_divide_b),
        .range_x2(device_range_x2),
        .initial_phase(settings_port_initial_phase),
        .compensation(settings_port_compensation),
        .compensation_insert(settings_port_compensation_insert),
        .step_period(settings_port_step_period),
        .t1(device_t1),
        .t2(device_t2),
        .standard(device_standard),
        .cp1(device_cp1),
        .cp2(device_cp2),
        .q(device_q),
        .q_bar(device_q_bar),
        .step(device_step),
        .forward(device_forward),
        .reverse(device_reverse),
        .phase_a(device_phase_a),
        .phase_b(device_phase_b),
        .phase_c(device_phase_c),
        .count(device_count),
        .count_forward(device_count_forward),
        .zero(device_zero),
        .fault(device_fault),
        .measuring(device_measuring),
        .grating_divided(device_grating_divided),
        .laser_divided(device_laser_divided)
    );

    step_driver step_driver (
        .clock(clock),
        .clear(reset),
        .step(device_step),
        .forward(device_forward),
        .step_pin(step_driver_step_pin),
        .direction_pin(step_driver_direction_pin)
    );

    step_clock milliseconds (
        .clock(clock),
        .clear(reset),
        .period(tick_period),
        .tick(milliseconds_tick)
    );

    supervisor supervisor (
        .clock(clock),
        .clear(supervisor_clear),
        .tick(milliseconds_tick),
        .limit(watchdog_ticks),
        .wrap_watched(supervisor_wrap_watched),
        .measuring(device_measuring),
        .line(lines_rising),
        .fringe(fringes_rising),
        .opening(device_grating_divided),
        .shutting(device_laser_divided),
        .enable(supervisor_enable),
        .stop(supervisor_stop),
        .may_correct(supervisor_may_correct),
        .may_step(supervisor_may_step),
        .stopped(supervisor_stopped),
        .lines_missing(supervisor_lines_missing),
        .fringes_missing(supervisor_fringes_missing),
        .wrapped(supervisor_wrapped),
        .alarm(supervisor_alarm)
    );

    telemetry telemetry (
        .clock(clock),
        .clear(reset),
        .measuring(device_measuring),
        .opening(device_grating_divided),
        .meter(device_t1),
        .forward(device_q),
        .count(device_count),
        .count_forward(device_count_forward),
        .fault(device_fault),
        .alarm(supervisor_alarm),
        .ready(settings_port_telemetry_ready),
        .send(telemetry_send),
        .data(telemetry_data)
    );

    uart_transmitter transmitter (
        .clock(clock),
        .clear(reset),
        .bit_clocks(bit_clocks),
        .send(settings_port_send),
        .data(settings_port_data),
        .line(transmitter_line),
        .ready(transmitter_ready)
    );

    uart_receiver receiver (
        .clock(clock),
        .clear(reset),
        .bit_clocks(bit_clocks),
        .line(rx),
        .received(receiver_received),
        .data(receiver_data)
    );

    settings_port settings_port (
        .clock(clock),
        .clear(reset),
        .at_rest(settings_port_at_rest),
        .received(receiver_received),
        .received_byte(receiver_data),
        .telemetry_send(telemetry_send),
        .telemetry_byte(telemetry_data),
        .ready(transmitter_ready),
        .tick_period(tick_period),
        .built_divide_a(divide_a),
        .built_divide_b(divide_b),
        .built_range_x2(range_set),
        .built_initial_phase(initial_phase),
        .built_compensation(compensation),
        .built_compensation_insert(compensation_insert),
        .built_step_period(step_period),
        .divide_a(settings_port_divide_a),
        .divide_b(settings_port_divide_b),
        .range_x2(settings_port_range_x2),
        .initial_phase(settings_port_initial_phase),
        .compensation(settings_port_compensation),
        .compensation_insert(settings_port_compensation_insert),
        .step_period(settings_port_step_period),
        .telemetry_ready(settings_port_telemetry_ready),
        .send(settings_port_send),
        .data(settings_port_data)
    );

    input_conditioner grating_input (
        .clock(clock),
        .pin(grating),
        .active_low(nothing),
        .tick(every_clock),
        .ticks(glitch_clocks),
        .level(grating_input_level),
        .steady(grating_input_steady)
    );

    input_conditioner laser_input (
        .clock(clock),
        .pin(laser),
        .active_low(nothing),
        .tick(every_clock),
        .ticks(glitch_clocks),
        .level(laser_input_level),
        .steady(laser_input_steady)
    );

    input_conditioner start_input (
        .clock(clock),
        .pin(start),
        .active_low(active_low),
        .tick(milliseconds_tick),
        .ticks(debounce_ticks),
        .level(start_input_level),
        .steady(start_input_steady)
    );

    input_conditioner correct_input (
        .clock(clock),
        .pin(correct),
        .active_low(active_low),
        .tick(milliseconds_tick),
        .ticks(debounce_ticks),
        .level(correct_input_level),
        .steady(correct_input_steady)
    );

    input_conditioner playback_input (
        .clock(clock),
        .pin(playback),
        .active_low(active_low),
        .tick(milliseconds_tick),
        .ticks(debounce_ticks),
        .level(playback_input_level),
        .steady(playback_input_steady)
    );

    input_conditioner manual_step_input (
        .clock(clock),
        .pin(manual_step),
        .active_low(active_low),
        .tick(milliseconds_tick),
        .ticks(debounce_ticks),
        .level(manual_step_input_level),
        .steady(manual_step_input_steady)
    );

    input_conditioner range_input (
        .clock(clock),
        .pin(range_x2),
        .active_low(active_low),
        .tick(milliseconds_tick),
        .ticks(debounce_ticks),
        .level(range_input_level),
        .steady(range_input_steady)
    );

    input_conditioner enable_input (
        .clock(clock),
        .pin(enable),
        .active_low(active_low),
        .tick(milliseconds_tick),
        .ticks(debounce_ticks),
        .level(enable_input_level),
        .steady(enable_input_steady)
    );

    level_synchroniser stop_input (
        .clock(clock),
        .pin(emergency_stop),
        .level(stop_input_level)
    );

    input_conditioner grating_b_input (
        .clock(clock),
        .pin(grating_b),
        .active_low(nothing),
        .tick(every_clock),
        .ticks(glitch_clocks),
        .level(grating_b_input_level),
        .steady(grating_b_input_steady)
    );

    input_conditioner laser_b_input (
        .clock(clock),
        .pin(laser_b),
        .active_low(nothing),
        .tick(every_clock),
        .ticks(glitch_clocks),
        .level(laser_b_input_level),
        .steady(laser_b_input_steady)
    );

    input_conditioner grating_index_input (
        .clock(clock),
        .pin(grating_index),
        .active_low(nothing),
        .tick(every_clock),
        .ticks(glitch_clocks),
        .level(grating_index_input_level),
        .steady(grating_index_input_steady)
    );

    input_conditioner laser_index_input (
        .clock(clock),
        .pin(laser_index),
        .active_low(nothing),
        .tick(every_clock),
        .ticks(glitch_clocks),
        .level(laser_index_input_level),
        .steady(laser_index_input_steady)
    );

    quadrature_decoder grating_decoder (
        .clock(clock),
        .clear(at_rest),
        .a(grating_input_steady),
        .b(grating_b_input_steady),
        .pulse(grating_decoder_pulse),
        .behind(grating_decoder_behind),
        .lost(grating_decoder_lost)
    );

    quadrature_decoder laser_decoder (
        .clock(clock),
        .clear(at_rest),
        .a(laser_input_steady),
        .b(laser_b_input_steady),
        .pulse(laser_decoder_pulse),
        .behind(laser_decoder_behind),
        .lost(laser_decoder_lost)
    );

    index_gate grating_gate (
        .clock(clock),
        .wired(grating_index_wired),
        .start(start_input_level),
        .started(start_input_steady),
        .index(grating_index_input_steady),
        .open(grating_gate_open)
    );

    index_gate laser_gate (
        .clock(clock),
        .wired(laser_index_wired),
        .start(start_input_level),
        .started(start_input_steady),
        .index(laser_index_input_steady),
        .open(laser_gate_open)
    );

    input_synchroniser lines (
        .clock(clock),
        .pin(grating_input_steady),
        .rising(lines_rising)
    );

    input_synchroniser fringes (
        .clock(clock),
        .pin(laser_input_steady),
        .rising(fringes_rising)
    );

    assign power_up_next = power_up_q + 4'd1;
    assign reset = ~(&power_up_q);

    always @* begin
        power_up_d = power_up_q;
        if (reset) begin
            power_up_d = power_up_next;
        end
    end

    assign every_clock = 1'b1;
    assign nothing = 1'b0;
    assign at_rest = reset | ~start_input_steady;
    assign idle = ~start_input_steady & ~correct_input_steady & ~playback_input_steady;
    assign supervisor_clear = reset | idle;
    assign supervisor_wrap_watched = correct_input_steady & (|watchdog_ticks);
    assign supervisor_enable = enable_input_steady | ~enable_wired;
    assign supervisor_stop = stop_input_level | (grating_decoder_lost & grating_b_wired)
        | (laser_decoder_lost & laser_b_wired);

    always @* begin
        if (grating_b_wired) begin
            device_grating = grating_decoder_pulse;
        end else begin
            device_grating = grating_input_level;
        end
    end

    always @* begin
        if (laser_b_wired) begin
            device_laser = laser_decoder_pulse;
        end else begin
            device_laser = laser_input_level;
        end
    end

    assign device_start = grating_gate_open & laser_gate_open;
    assign device_correct = correct_input_level & supervisor_may_correct;
    assign device_playback = playback_input_level & supervisor_may_step;
    assign device_calibrate = calibrate ^ calibrate_inverted;
    assign device_manual_step = manual_step_input_level & supervisor_may_step;
    assign device_manual_forward = manual_forward ^ active_low;
    assign device_range_x2 = settings_port_range_x2 | (range_input_steady & range_wired);
    assign tx = transmitter_line;
    assign settings_port_at_rest = idle & ~device_measuring;
    assign t1 = device_t1;
    assign t2 = device_t2;
    assign phase_a = device_phase_a & ~supervisor_stopped;
    assign phase_b = device_phase_b & ~supervisor_stopped;
    assign phase_c = device_phase_c & ~supervisor_stopped;
    assign step = step_driver_step_pin;
    assign direction = step_driver_direction_pin;
    assign zero = device_zero;
    assign fault = device_fault;
    assign measuring = device_measuring;
    assign alarm = supervisor_alarm;

    initial begin
        power_up_q = 4'd0;
    end

    always @(posedge clock) begin
        power_up_q <= power_up_d;
    end

    // Without a reader here; named so that linters know it is meant.
    wire unused_bits = &{1'b0, device_standard, device_cp1, device_cp2, device_q_bar, device_reverse, supervisor_lines_missing, supervisor_fringes_missing, supervisor_wrapped, manual_step_input_steady, range_input_level, enable_input_level, grating_b_input_level, laser_b_input_level, grating_index_input_level, laser_index_input_level, grating_decoder_behind, laser_decoder_behind};
endmodule

`default_nettype wire
