// SPDX-License-Identifier: MIT OR Apache-2.0
// telemetry: A frame for every comparison: width, period, steps

`default_nettype none

module telemetry (
    // clock: FPGA clock, rising edge
    input  wire         clock,
    // clear: no comparison begun, nothing to send
    input  wire         clear,
    // measuring: the initial phase is selected
    input  wire         measuring,
    // opening: high for one clock: a comparison ends and the next begins
    input  wire         opening,
    // meter: T1
    input  wire         meter,
    // forward: the discriminator's Q
    input  wire         forward,
    // count: steps away from zero
    input  wire [11:0]  count,
    // count_forward: on which side
    input  wire         count_forward,
    // fault: a step was refused
    input  wire         fault,
    // alarm: the supervisor's
    input  wire         alarm,
    // ready: the transmitter takes a byte
    input  wire         ready,
    // send: high for one clock: data is the next byte
    output reg          send,
    // data: that byte
    output reg  [7:0]   data
);

    wire [31:0] since_more;
    wire [31:0] high_more;
    wire full;
    wire [15:0] number_more;
    wire ends;
    reg [15:0] forward_bit;
    reg [15:0] decision_bit;
    reg [15:0] fault_bit;
    reg [15:0] alarm_bit;
    wire [15:0] state;
    wire [63:0] state_wide;
    wire [55:0] fresh_low;
    wire [63:0] fresh_upper;
    wire [55:0] number_wide;
    wire [55:0] width_wide;
    wire [63:0] period_wide;
    wire [15:0] count_wide;
    wire [55:0] check_wide;
    reg [55:0] turned_low;
    reg [63:0] turned_upper;
    wire [6:0] turns_less;
    wire [3:0] place_more;
    wire [3:0] sent_more;
    wire [3:0] left;
    wire [3:0] run_more;
    wire [3:0] run_less;
    wire [7:0] run_wide;
    wire [7:0] code;
    wire still;
    wire remains;
    wire zero;
    wire remainder_clear;
    wire remainder_take;
    wire [15:0] remainder_check;
    reg begun_d;
    reg begun_q;
    reg [31:0] since_d;
    reg [31:0] since_q;
    reg [31:0] high_d;
    reg [31:0] high_q;
    reg [15:0] number_d;
    reg [15:0] number_q;
    reg [55:0] low_d;
    reg [55:0] low_q;
    reg [63:0] upper_d;
    reg [63:0] upper_q;
    reg [2:0] phase_d;
    reg [2:0] phase_q;
    reg [6:0] turns_d;
    reg [6:0] turns_q;
    reg [3:0] place_d;
    reg [3:0] place_q;
    reg [3:0] sent_d;
    reg [3:0] sent_q;
    reg [3:0] run_d;
    reg [3:0] run_q;
    reg found_d;
    reg found_q;
    reg at_zero_d;
    reg at_zero_q;

    frame_check remainder (
        .clock(clock),
        .clear(remainder_clear),
        .take(remainder_take),
        .level(low_q[0]),
        .check(remainder_check)
    );

    assign since_more = since_q + 32'h1;
    assign high_more = high_q + 32'h1;
    assign full = since_q[31];

    always @* begin
        since_d = since_q;
        if (opening) begin
            since_d = 32'h1;
        end else if (~full) begin
            since_d = since_more;
        end
    end

    always @* begin
        high_d = high_q;
        if (opening & meter) begin
            high_d = 32'h1;
        end else if (opening) begin
            high_d = 32'h0;
        end else if (meter & ~full) begin
            high_d = high_more;
        end
    end

    assign number_more = number_q + 16'h1;
    assign ends = begun_q & opening;

    always @* begin
        begun_d = begun_q;
        if (clear | ~measuring) begin
            begun_d = 1'b0;
        end else if (opening) begin
            begun_d = 1'b1;
        end
    end

    always @* begin
        number_d = number_q;
        if (clear | ~measuring) begin
            number_d = 16'h0;
        end else if (ends) begin
            number_d = number_more;
        end
    end

    always @* begin
        forward_bit = 16'h0;
        if (count_forward) begin
            forward_bit = 16'h1000;
        end
    end

    always @* begin
        decision_bit = 16'h0;
        if (forward) begin
            decision_bit = 16'h2000;
        end
    end

    always @* begin
        fault_bit = 16'h0;
        if (fault) begin
            fault_bit = 16'h4000;
        end
    end

    always @* begin
        alarm_bit = 16'h0;
        if (alarm) begin
            alarm_bit = 16'h8000;
        end
    end

    assign count_wide = {4'd0, count};
    assign state = count_wide | forward_bit | decision_bit | fault_bit | alarm_bit;
    assign state_wide = {48'h0, state};
    assign number_wide = {40'h0, number_q};
    assign width_wide = {24'h0, high_q};
    assign period_wide = {32'h0, since_q};
    assign fresh_low = (number_wide << 56'h8) | (width_wide << 56'h18) | 56'h1;
    assign fresh_upper = period_wide | (state_wide << 64'h20);

    always @* begin
        turned_low = {1'b0, low_q[55:1]};
        if (upper_q[0]) begin
            turned_low = {1'b0, low_q[55:1]} | 56'h80000000000000;
        end
    end

    always @* begin
        turned_upper = {1'b0, upper_q[63:1]};
        if (low_q[0]) begin
            turned_upper = {1'b0, upper_q[63:1]} | 64'h8000000000000000;
        end
    end

    assign check_wide = {40'h0, remainder_check};
    assign still = turns_q == 7'h0;
    assign turns_less = turns_q - 7'h1;
    assign place_more = place_q + 4'd1;
    assign sent_more = sent_q + 4'd1;
    assign left = ~sent_q;
    assign run_more = run_q + 4'd1;
    assign run_less = run_q - 4'd1;
    assign remains = place_q < left;
    assign zero = low_q[7:0] == 8'h0;
    assign run_wide = {4'd0, run_q};
    assign code = run_wide + 8'h1;
    assign remainder_clear = phase_q == 3'd0;
    assign remainder_take = ~still;

    always @* begin
        low_d = low_q;
        upper_d = upper_q;
        phase_d = phase_q;
        turns_d = turns_q;
        place_d = place_q;
        sent_d = sent_q;
        run_d = run_q;
        found_d = found_q;
        at_zero_d = at_zero_q;
        data = low_q[7:0];
        send = 1'b0;
        if (~still) begin
            low_d = turned_low;
            upper_d = turned_upper;
            turns_d = turns_less;
        end else if ((phase_q == 3'd0) & ends) begin
            low_d = fresh_low;
            upper_d = fresh_upper;
            turns_d = 7'h68;
            phase_d = 3'd1;
        end else if (phase_q == 3'd1) begin
            low_d = low_q ^ check_wide;
            turns_d = 7'h10;
            phase_d = 3'd2;
        end else if (phase_q == 3'd2) begin
            place_d = place_more;
            if (place_q == 4'd15) begin
                found_d = 1'b0;
                phase_d = 3'd3;
            end else begin
                turns_d = 7'h8;
                if (remains & ~zero & ~found_q) begin
                    run_d = run_more;
                end else if (~found_q) begin
                    found_d = 1'b1;
                    at_zero_d = remains;
                end
            end
        end else if ((phase_q == 3'd3) & ready) begin
            data = code;
            send = 1'b1;
            phase_d = 3'd4;
        end else if ((phase_q == 3'd4) & (|run_q)) begin
            if (ready) begin
                send = 1'b1;
                run_d = run_less;
                sent_d = sent_more;
                turns_d = 7'h8;
            end
        end else if ((phase_q == 3'd4) & at_zero_q) begin
            sent_d = sent_more;
            turns_d = 7'h8;
            phase_d = 3'd2;
        end else if (phase_q == 3'd4) begin
            phase_d = 3'd5;
        end else if ((phase_q == 3'd5) & ready) begin
            data = 8'h0;
            send = 1'b1;
            sent_d = sent_more;
            phase_d = 3'd0;
        end
        if (clear) begin
            phase_d = 3'd0;
            turns_d = 7'h0;
            place_d = 4'd0;
            sent_d = 4'd0;
            run_d = 4'd0;
            found_d = 1'b0;
            at_zero_d = 1'b0;
        end
    end

    initial begin
        begun_q = 1'b0;
        since_q = 32'h0;
        high_q = 32'h0;
        number_q = 16'h0;
        low_q = 56'h0;
        upper_q = 64'h0;
        phase_q = 3'd0;
        turns_q = 7'h0;
        place_q = 4'd0;
        sent_q = 4'd0;
        run_q = 4'd0;
        found_q = 1'b0;
        at_zero_q = 1'b0;
    end

    always @(posedge clock) begin
        begun_q <= begun_d;
        since_q <= since_d;
        high_q <= high_d;
        number_q <= number_d;
        low_q <= low_d;
        upper_q <= upper_d;
        phase_q <= phase_d;
        turns_q <= turns_d;
        place_q <= place_d;
        sent_q <= sent_d;
        run_q <= run_d;
        found_q <= found_d;
        at_zero_q <= at_zero_d;
    end
endmodule

`default_nettype wire
