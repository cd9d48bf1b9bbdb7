// SPDX-License-Identifier: MIT OR Apache-2.0
// logic_analyser: What eight signals did, told to programs that speak SUMP

`default_nettype none

module logic_analyser (
    // clock: FPGA clock, rising edge
    input  wire         clock,
    // clear: nothing captured, nothing told
    input  wire         clear,
    // probes: the signals
    input  wire [7:0]   probes,
    // received: high for one clock: received_byte has come from the computer
    input  wire         received,
    // received_byte: that byte
    input  wire [7:0]   received_byte,
    // ready: the transmitter takes a byte
    input  wire         ready,
    // rate: clocks a second, as it tells the computer
    input  wire [31:0]  rate,
    // megahertz: the same in MHz
    input  wire [6:0]   megahertz,
    // ticks: whole ticks of 10 ns in a clock, 100/MHz
    input  wire [3:0]   ticks,
    // ticks_rest: what that division leaves
    input  wire [6:0]   ticks_rest,
    // memory_data: the byte that stood at memory_address one clock ago
    input  wire [7:0]   memory_data,
    // memory_address: place of the next sample, or of the one that is told
    output wire [11:0]  memory_address,
    // memory_write: memory_sample is put there
    output wire         memory_write,
    // memory_sample: the signals, two clocks late
    output wire [7:0]   memory_sample,
    // send: high for one clock: data goes out
    output wire         send,
    // data: the byte
    output reg  [7:0]   data
);

    wire heard;
    wire is_short;
    wire last_argument;
    wire [31:0] byte_wide;
    wire [31:0] arrived;
    wire [2:0] missing_less;
    wire resets;
    wire runs;
    wire [7:0] fraction_wide;
    wire [7:0] rest_wide;
    wire [7:0] megahertz_wide;
    wire [7:0] fraction_sum;
    wire [7:0] fraction_over;
    wire whole;
    wire [24:0] ticks_wide;
    reg [24:0] ticks_now;
    wire [24:0] left_wide;
    wire [24:0] divider_wide;
    wire [24:0] left_less;
    wire [24:0] left_again;
    wire running;
    wire due;
    wire fits;
    wire [9:0] ahead;
    wire [12:0] ahead_wide;
    wire [12:0] after_wide;
    wire [12:0] total_wide;
    wire [12:0] after_count;
    wire [12:0] total_count;
    wire [12:0] samples_less;
    wire last_sample;
    wire [11:0] address_more;
    wire [11:0] address_less;
    wire [4:0] place_more;
    wire tells;
    wire gives;
    reg [7:0] answer;
    wire [7:0] early_d;
    (* ASYNC_REG = "TRUE", keep = "true" *) reg [7:0] early_q;
    wire [7:0] seen_d;
    (* ASYNC_REG = "TRUE", keep = "true" *) reg [7:0] seen_q;
    reg [7:0] command_d;
    reg [7:0] command_q;
    reg [31:0] arguments_d;
    reg [31:0] arguments_q;
    reg [2:0] missing_d;
    reg [2:0] missing_q;
    reg [23:0] divider_d;
    reg [23:0] divider_q;
    reg [9:0] total_d;
    reg [9:0] total_q;
    reg [9:0] after_d;
    reg [9:0] after_q;
    reg [7:0] mask_d;
    reg [7:0] mask_q;
    reg [7:0] value_d;
    reg [7:0] value_q;
    reg [2:0] phase_d;
    reg [2:0] phase_q;
    reg [12:0] samples_left_d;
    reg [12:0] samples_left_q;
    reg [11:0] address_d;
    reg [11:0] address_q;
    reg [23:0] ticks_left_d;
    reg [23:0] ticks_left_q;
    reg [6:0] fraction_d;
    reg [6:0] fraction_q;
    reg telling_d;
    reg telling_q;
    reg [4:0] place_d;
    reg [4:0] place_q;

    assign early_d = probes;
    assign seen_d = early_q;
    assign heard = received & (missing_q == 3'd0);
    assign is_short = heard & ~received_byte[7];
    assign last_argument = received & (missing_q == 3'd1);
    assign byte_wide = {24'h0, received_byte};
    assign arrived = {8'h0, arguments_q[31:8]} | (byte_wide << 32'h18);
    assign missing_less = missing_q - 3'd1;
    assign resets = is_short & (received_byte == 8'h0);
    assign runs = is_short & (received_byte == 8'h1);
    assign fraction_wide = {1'b0, fraction_q};
    assign rest_wide = {1'b0, ticks_rest};
    assign megahertz_wide = {1'b0, megahertz};
    assign fraction_sum = fraction_wide + rest_wide;
    assign fraction_over = fraction_sum - megahertz_wide;
    assign whole = megahertz_wide <= fraction_sum;
    assign ticks_wide = {21'h0, ticks};

    always @* begin
        ticks_now = ticks_wide;
        if (whole) begin
            ticks_now = ticks_wide + 25'h1;
        end
    end

    assign left_wide = {1'b0, ticks_left_q};
    assign divider_wide = {1'b0, divider_q};
    assign left_less = left_wide - ticks_now;
    assign left_again = left_less + divider_wide + 25'h1;
    assign running = (phase_q == 3'd1) | (phase_q == 3'd2);
    assign due = running & left_less[24];
    assign fits = ((seen_q ^ value_q) & mask_q) == 8'h0;
    assign ahead = total_q - after_q;
    assign ahead_wide = {3'd0, ahead};
    assign after_wide = {3'd0, after_q};
    assign total_wide = {3'd0, total_q};
    assign after_count = (after_wide << 13'h2) + 13'h4;
    assign total_count = (total_wide << 13'h2) + 13'h4;
    assign samples_less = samples_left_q - 13'h1;
    assign last_sample = samples_left_q == 13'h1;
    assign address_more = address_q + 12'h1;
    assign address_less = address_q - 12'h1;
    assign tells = telling_q & ready;
    assign gives = (phase_q == 3'd5) & ready & ~telling_q;
    assign place_more = place_q + 5'h1;

    always @* begin
        case (place_q)
            5'h0: begin
                answer = 8'h31;
            end
            5'h1: begin
                answer = 8'h41;
            end
            5'h2: begin
                answer = 8'h4c;
            end
            5'h3: begin
                answer = 8'h53;
            end
            5'h4: begin
                answer = 8'h1;
            end
            5'h5: begin
                answer = 8'h68;
            end
            5'h6: begin
                answer = 8'h65;
            end
            5'h7: begin
                answer = 8'h6c;
            end
            5'h8: begin
                answer = 8'h69;
            end
            5'h9: begin
                answer = 8'h78;
            end
            5'ha: begin
                answer = 8'h6c;
            end
            5'hb: begin
                answer = 8'h6f;
            end
            5'hc: begin
                answer = 8'h63;
            end
            5'hd: begin
                answer = 8'h6b;
            end
            5'hf: begin
                answer = 8'h21;
            end
            5'h12: begin
                answer = 8'h10;
            end
            5'h14: begin
                answer = 8'h23;
            end
            5'h15: begin
                answer = rate[31:24];
            end
            5'h16: begin
                answer = rate[23:16];
            end
            5'h17: begin
                answer = rate[15:8];
            end
            5'h18: begin
                answer = rate[7:0];
            end
            5'h19: begin
                answer = 8'h40;
            end
            5'h1a: begin
                answer = 8'h8;
            end
            5'h1b: begin
                answer = 8'h41;
            end
            5'h1c: begin
                answer = 8'h2;
            end
            default: begin
                answer = 8'h0;
            end
        endcase
    end

    always @* begin
        command_d = command_q;
        arguments_d = arguments_q;
        missing_d = missing_q;
        divider_d = divider_q;
        total_d = total_q;
        after_d = after_q;
        mask_d = mask_q;
        value_d = value_q;
        phase_d = phase_q;
        samples_left_d = samples_left_q;
        address_d = address_q;
        ticks_left_d = ticks_left_q;
        fraction_d = fraction_q;
        telling_d = telling_q;
        place_d = place_q;
        if (heard & received_byte[7]) begin
            command_d = received_byte;
            missing_d = 3'd4;
        end else if (received & ~heard) begin
            arguments_d = arrived;
            missing_d = missing_less;
        end
        if (last_argument & (command_q == 8'h80)) begin
            divider_d = arrived[23:0];
        end else if (last_argument & (command_q == 8'h81)) begin
            total_d = arrived[9:0];
            after_d = arrived[25:16];
        end else if (last_argument & (command_q == 8'hc0)) begin
            mask_d = arrived[7:0];
        end else if (last_argument & (command_q == 8'hc1)) begin
            value_d = arrived[7:0];
        end
        if (running) begin
            if (whole) begin
                fraction_d = fraction_over[6:0];
            end else begin
                fraction_d = fraction_sum[6:0];
            end
            if (~left_less[24]) begin
                ticks_left_d = left_less[23:0];
            end else if (left_again[24]) begin
                ticks_left_d = 24'h0;
            end else begin
                ticks_left_d = left_again[23:0];
            end
        end
        if (due) begin
            address_d = address_more;
            samples_left_d = samples_less;
            if ((phase_q == 3'd2) & last_sample) begin
                phase_d = 3'd3;
                samples_left_d = total_count;
            end else if ((phase_q == 3'd1) & ~(|samples_left_q)) begin
                samples_left_d = 13'h0;
                if (fits) begin
                    phase_d = 3'd2;
                    samples_left_d = after_count;
                end
            end
        end else if (phase_q == 3'd3) begin
            address_d = address_less;
            phase_d = 3'd4;
        end else if (phase_q == 3'd4) begin
            phase_d = 3'd5;
        end else if (gives) begin
            samples_left_d = samples_less;
            phase_d = 3'd3;
            if (last_sample) begin
                phase_d = 3'd0;
            end
        end
        if (runs) begin
            phase_d = 3'd1;
            samples_left_d = ahead_wide << 13'h2;
            ticks_left_d = 24'h0;
            fraction_d = 7'h0;
        end else if (resets) begin
            phase_d = 3'd0;
        end
        if (is_short & (received_byte == 8'h2)) begin
            telling_d = 1'b1;
            place_d = 5'h0;
        end else if (is_short & (received_byte == 8'h4)) begin
            telling_d = 1'b1;
            place_d = 5'h4;
        end else if (resets) begin
            telling_d = 1'b0;
        end else if (tells) begin
            place_d = place_more;
            if ((place_q == 5'h3) | (place_q == 5'h1d)) begin
                telling_d = 1'b0;
            end
        end
        if (clear) begin
            missing_d = 3'd0;
            divider_d = 24'h0;
            total_d = 10'h0;
            after_d = 10'h0;
            mask_d = 8'h0;
            value_d = 8'h0;
            phase_d = 3'd0;
            telling_d = 1'b0;
        end
    end

    assign memory_address = address_q;
    assign memory_write = due;
    assign memory_sample = seen_q;
    assign send = tells | gives;

    always @* begin
        data = memory_data;
        if (telling_q) begin
            data = answer;
        end
    end

    initial begin
        early_q = 8'h0;
        seen_q = 8'h0;
        command_q = 8'h0;
        arguments_q = 32'h0;
        missing_q = 3'd0;
        divider_q = 24'h0;
        total_q = 10'h0;
        after_q = 10'h0;
        mask_q = 8'h0;
        value_q = 8'h0;
        phase_q = 3'd0;
        samples_left_q = 13'h0;
        address_q = 12'h0;
        ticks_left_q = 24'h0;
        fraction_q = 7'h0;
        telling_q = 1'b0;
        place_q = 5'h0;
    end

    always @(posedge clock) begin
        early_q <= early_d;
        seen_q <= seen_d;
        command_q <= command_d;
        arguments_q <= arguments_d;
        missing_q <= missing_d;
        divider_q <= divider_d;
        total_q <= total_d;
        after_q <= after_d;
        mask_q <= mask_d;
        value_q <= value_d;
        phase_q <= phase_d;
        samples_left_q <= samples_left_d;
        address_q <= address_d;
        ticks_left_q <= ticks_left_d;
        fraction_q <= fraction_d;
        telling_q <= telling_d;
        place_q <= place_d;
    end

    // Without a reader here; named so that linters know it is meant.
    wire unused_bits = &{1'b0, fraction_over[7]};
endmodule

`default_nettype wire
