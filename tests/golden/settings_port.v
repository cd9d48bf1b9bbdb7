// SPDX-License-Identifier: MIT OR Apache-2.0
// settings_port: Wheels turned over a serial port while the device is at rest

`default_nettype none

module settings_port (
    // clock: FPGA clock, rising edge
    input  wire         clock,
    // clear: the bitstream's settings, nothing asked
    input  wire         clear,
    // at_rest: wheels may be turned
    input  wire         at_rest,
    // received: high for one clock: received_byte has come from the computer
    input  wire         received,
    // received_byte: that byte, steady for four clocks more
    input  wire [7:0]   received_byte,
    // telemetry_send: the telemetry sends telemetry_byte
    input  wire         telemetry_send,
    // telemetry_byte: its byte
    input  wire [7:0]   telemetry_byte,
    // ready: the transmitter takes a byte
    input  wire         ready,
    // tick_period: clocks of a millisecond, for the identity
    input  wire [23:0]  tick_period,
    // built_divide_a: A of the bitstream, BCD
    input  wire [11:0]  built_divide_a,
    // built_divide_b: B of the bitstream, BCD
    input  wire [11:0]  built_divide_b,
    // built_range_x2: range of the bitstream
    input  wire         built_range_x2,
    // built_initial_phase: m of the bitstream, BCD
    input  wire [11:0]  built_initial_phase,
    // built_compensation: F/1000 of the bitstream, BCD
    input  wire [15:0]  built_compensation,
    // built_compensation_insert: insert, of the bitstream
    input  wire         built_compensation_insert,
    // built_step_period: step period of the bitstream
    input  wire [23:0]  built_step_period,
    // divide_a: A in BCD
    output wire [11:0]  divide_a,
    // divide_b: B in BCD
    output wire [11:0]  divide_b,
    // range_x2: ×2 instead of ×1
    output wire         range_x2,
    // initial_phase: m in BCD
    output wire [11:0]  initial_phase,
    // compensation: F/1000 in BCD
    output wire [15:0]  compensation,
    // compensation_insert: insert instead of block
    output wire         compensation_insert,
    // step_period: clocks from step to step
    output wire [23:0]  step_period,
    // telemetry_ready: the transmitter takes a byte of the telemetry
    output wire         telemetry_ready,
    // send: data goes out
    output reg          send,
    // data: the byte
    output reg  [7:0]   data
);

    wire [35:0] built_a_wide;
    wire [35:0] built_b_wide;
    wire [35:0] built_m_wide;
    wire [41:0] built_f_wide;
    wire [41:0] built_period_wide;
    reg [41:0] built_range_wide;
    reg [41:0] built_insert_wide;
    wire [35:0] low_built;
    wire [41:0] high_built;
    wire [35:0] low_set;
    wire [41:0] high_set;
    wire [35:0] low_asked;
    wire [41:0] high_asked;
    wire [35:0] low_over;
    wire [41:0] high_over;
    wire [23:0] period_asked;
    wire shown;
    wire [3:0] kind;
    reg [39:0] outcome;
    wire turning;
    wire in_content;
    wire [4:0] place_more;
    wire [2:0] turns_less;
    reg coming;
    reg passing;
    reg [39:0] low_turned;
    reg [43:0] high_turned;
    wire [43:0] tick_wide;
    wire [39:0] low_wide;
    reg [39:0] low_told;
    reg [43:0] high_told;
    wire [39:0] told;
    wire heard;
    wire begins;
    wire digit;
    wire asked;
    wire answers;
    wire writes;
    wire claims;
    wire sends;
    wire [7:0] low_digit;
    wire [7:0] check_digit;
    wire remainder_clear;
    wire [15:0] remainder_check;
    reg [39:0] low_d;
    reg [39:0] low_q;
    reg [43:0] high_d;
    reg [43:0] high_q;
    reg [35:0] low_changed_d;
    reg [35:0] low_changed_q;
    reg [41:0] high_changed_d;
    reg [41:0] high_changed_q;
    reg [4:0] place_d;
    reg [4:0] place_q;
    reg [2:0] turns_d;
    reg [2:0] turns_q;
    reg pending_d;
    reg pending_q;
    reg answering_d;
    reg answering_q;
    reg telemetry_busy_d;
    reg telemetry_busy_q;

    frame_check remainder (
        .clock(clock),
        .clear(remainder_clear),
        .take(turning),
        .level(passing),
        .check(remainder_check)
    );

    assign built_a_wide = {24'h0, built_divide_a};
    assign built_b_wide = {24'h0, built_divide_b};
    assign built_m_wide = {24'h0, built_initial_phase};
    assign built_f_wide = {26'h0, built_compensation};
    assign built_period_wide = {18'h0, built_step_period};

    always @* begin
        built_range_wide = 42'h0;
        if (built_range_x2) begin
            built_range_wide = 42'h10000000000;
        end
    end

    always @* begin
        built_insert_wide = 42'h0;
        if (built_compensation_insert) begin
            built_insert_wide = 42'h20000000000;
        end
    end

    assign low_built = built_a_wide | (built_b_wide << 36'hc) | (built_m_wide << 36'h18);
    assign high_built = built_f_wide | (built_period_wide << 42'h10) | built_range_wide
        | built_insert_wide;
    assign low_set = low_built ^ low_changed_q;
    assign high_set = high_built ^ high_changed_q;
    assign divide_a = low_set[11:0];
    assign divide_b = low_set[23:12];
    assign initial_phase = low_set[35:24];
    assign compensation = high_set[15:0];
    assign step_period = high_set[39:16];
    assign range_x2 = high_set[40];
    assign compensation_insert = high_set[41];
    assign kind = low_q[3:0];
    assign low_asked = low_q[39:4];
    assign high_asked = high_q[41:0];
    assign low_over = low_asked & ((low_asked << 36'h1) | (low_asked << 36'h2)) & 36'h888888888;
    assign high_over = {26'h0, high_asked[15:0]
        & ((high_asked[15:0] << 16'h1) | (high_asked[15:0] << 16'h2)) & 16'h8888};
    assign period_asked = high_asked[39:16];
    assign shown = ~(|low_over) & ~(|high_over) & (|low_asked[11:0]) & (|low_asked[23:12])
        & (24'h80 <= period_asked) & ~high_q[42] & ~high_q[43];
    assign turning = |turns_q;
    assign turns_less = turns_q - 3'd1;
    assign place_more = place_q + 5'h1;
    assign in_content = place_q < 5'h16;

    always @* begin
        if (turns_q == 3'd4) begin
            coming = received_byte[0];
        end else if (turns_q == 3'd3) begin
            coming = received_byte[1];
        end else if (turns_q == 3'd2) begin
            coming = received_byte[2];
        end else begin
            coming = received_byte[3];
        end
    end

    always @* begin
        if (~answering_q) begin
            passing = coming;
        end else if (in_content) begin
            passing = low_q[0];
        end else begin
            passing = ~remainder_check[0];
        end
    end

    always @* begin
        low_turned = {1'b0, low_q[39:1]};
        if (high_q[0]) begin
            low_turned = {1'b0, low_q[39:1]} | 40'h8000000000;
        end
    end

    always @* begin
        high_turned = {1'b0, high_q[43:1]};
        if (coming) begin
            high_turned = {1'b0, high_q[43:1]} | 44'h80000000000;
        end
    end

    assign heard = received & ~turning & ~pending_q & ~answering_q;
    assign begins = heard & (received_byte == 8'h1a);
    assign remainder_clear = (place_q == 5'h0) | begins;
    assign digit = heard & (received_byte[7:4] == 4'd3) & (place_q != 5'h0) & (place_q != 5'h1a);
    assign asked = heard & (received_byte == 8'h0) & (place_q == 5'h1a)
        & (remainder_check == 16'hf47);
    assign answers = asked & ((kind == 4'd1) | (kind == 4'd2) | (kind == 4'd3));
    assign writes = asked & (kind == 4'd3) & at_rest & shown;

    always @* begin
        outcome = low_q;
        if ((kind == 4'd3) & ~at_rest) begin
            outcome = 40'h4;
        end else if ((kind == 4'd3) & ~shown) begin
            outcome = 40'h5;
        end
    end

    assign claims = pending_q & ~telemetry_busy_q & ~telemetry_send;
    assign sends = answering_q & ready & ~turning;
    assign tick_wide = {20'h0, tick_period};
    assign low_wide = {4'd0, low_set};

    always @* begin
        if (kind == 4'd1) begin
            low_told = 40'h174300;
            high_told = tick_wide << 44'h10;
        end else begin
            low_told = low_wide << 40'h4;
            high_told = {2'd0, high_set};
        end
    end

    assign told = {36'h0, kind};

    always @* begin
        low_d = low_q;
        high_d = high_q;
        low_changed_d = low_changed_q;
        high_changed_d = high_changed_q;
        place_d = place_q;
        turns_d = turns_q;
        pending_d = pending_q;
        answering_d = answering_q;
        telemetry_busy_d = telemetry_busy_q;
        if (turning) begin
            turns_d = turns_less;
            if (turns_q == 3'd1) begin
                place_d = place_more;
            end
            if (in_content) begin
                low_d = low_turned;
                high_d = high_turned;
            end
        end else if (begins) begin
            place_d = 5'h1;
        end else if (digit) begin
            turns_d = 3'd4;
        end else if (heard) begin
            place_d = 5'h0;
            if (answers) begin
                pending_d = 1'b1;
                low_d = outcome;
            end
        end else if (claims) begin
            pending_d = 1'b0;
            answering_d = 1'b1;
            low_d = low_told | told;
            high_d = high_told;
        end else if (sends & (place_q == 5'h0)) begin
            place_d = 5'h1;
        end else if (sends & (place_q == 5'h1a)) begin
            place_d = 5'h0;
            answering_d = 1'b0;
        end else if (sends) begin
            turns_d = 3'd4;
        end
        if (writes) begin
            low_changed_d = low_asked ^ low_built;
            high_changed_d = high_asked ^ high_built;
        end
        if (telemetry_send) begin
            telemetry_busy_d = |telemetry_byte;
        end
        if (clear) begin
            low_changed_d = 36'h0;
            high_changed_d = 42'h0;
            place_d = 5'h0;
            turns_d = 3'd0;
            pending_d = 1'b0;
            answering_d = 1'b0;
            telemetry_busy_d = 1'b0;
        end
    end

    assign low_digit = {4'd0, kind};
    assign check_digit = {4'd0, remainder_check[3:0]};
    assign telemetry_ready = ready & ~answering_q;

    always @* begin
        if (~answering_q) begin
            send = telemetry_send;
            data = telemetry_byte;
        end else begin
            send = sends;
            if (place_q == 5'h0) begin
                data = 8'h1a;
            end else if (place_q == 5'h1a) begin
                data = 8'h0;
            end else if (in_content) begin
                data = low_digit | 8'h30;
            end else begin
                data = check_digit | 8'h30;
            end
        end
    end

    initial begin
        low_q = 40'h0;
        high_q = 44'h0;
        low_changed_q = 36'h0;
        high_changed_q = 42'h0;
        place_q = 5'h0;
        turns_q = 3'd0;
        pending_q = 1'b0;
        answering_q = 1'b0;
        telemetry_busy_q = 1'b0;
    end

    always @(posedge clock) begin
        low_q <= low_d;
        high_q <= high_d;
        low_changed_q <= low_changed_d;
        high_changed_q <= high_changed_d;
        place_q <= place_d;
        turns_q <= turns_d;
        pending_q <= pending_d;
        answering_q <= answering_d;
        telemetry_busy_q <= telemetry_busy_d;
    end
endmodule

`default_nettype wire
