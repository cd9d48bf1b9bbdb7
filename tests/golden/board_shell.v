// The device with its wheels set, and the pins a builder wires

`default_nettype none

module board_shell (
    input  wire         clock,
    input  wire         grating,
    input  wire         laser,
    input  wire         start,
    input  wire         correct,
    input  wire         playback,
    input  wire [1:0]   calibrate,
    input  wire         manual_step,
    input  wire         manual_forward,
    input  wire         range_x2,
    output wire         t1,
    output wire         t2,
    output wire         phase_a,
    output wire         phase_b,
    output wire         phase_c,
    output wire         step,
    output wire         direction,
    output wire         zero,
    output wire         fault,
    output wire         measuring
);

    wire [3:0] power_up_next;
    wire reset;
    localparam [11:0] divide_a = 12'h110;
    localparam [11:0] divide_b = 12'h150;
    localparam [11:0] initial_phase = 12'h150;
    localparam [15:0] compensation = 16'h0;
    localparam compensation_insert = 1'b0;
    localparam [23:0] step_period = 24'h124f8;
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
    reg [3:0] power_up_d;
    reg [3:0] power_up_q;

    device device (
        .clock(clock),
        .master_reset(reset),
        .grating(grating),
        .laser(laser),
        .start(start),
        .correct(correct),
        .playback(playback),
        .calibrate(calibrate),
        .manual_step(manual_step),
        .manual_forward(manual_forward),
        .divide_a(divide_a),
        .divide_b(divide_b),
        .range_x2(range_x2),
        .initial_phase(initial_phase),
        .compensation(compensation),
        .compensation_insert(compensation_insert),
        .step_period(step_period),
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

    assign power_up_next = power_up_q + 4'd1;
    assign reset = ~(&power_up_q);

    always @* begin
        power_up_d = power_up_q;
        if (reset) begin
            power_up_d = power_up_next;
        end
    end

    assign t1 = device_t1;
    assign t2 = device_t2;
    assign phase_a = device_phase_a;
    assign phase_b = device_phase_b;
    assign phase_c = device_phase_c;
    assign step = step_driver_step_pin;
    assign direction = step_driver_direction_pin;
    assign zero = device_zero;
    assign fault = device_fault;
    assign measuring = device_measuring;

    initial begin
        power_up_q = 4'd0;
    end

    always @(posedge clock) begin
        power_up_q <= power_up_d;
    end

    // Without a reader here; named so that linters know it is meant.
    wire unused_bits = &{1'b0, device_standard, device_cp1, device_cp2, device_q, device_q_bar, device_reverse, device_count, device_count_forward, device_grating_divided, device_laser_divided};
endmodule

`default_nettype wire
