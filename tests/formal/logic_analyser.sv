// A sample is the signals of two clocks ago, taken in the clock in which its tick falls; so many are
// taken before the trigger and behind it, and told from the last one back. Settings change by their
// commands alone, answers are told byte by byte, and a reset ends both.

module logic_analyser_proof(
    input clock, input clear, input [7:0] probes, input received, input [7:0] received_byte,
    input ready, input [31:0] rate, input [6:0] megahertz, input [3:0] ticks,
    input [6:0] ticks_rest, input [7:0] memory_data
);
    wire [11:0] memory_address;
    wire memory_write, send;
    wire [7:0] memory_sample, data;
    logic_analyser dut(.clock(clock), .clear(clear), .probes(probes), .received(received),
        .received_byte(received_byte), .ready(ready), .rate(rate), .megahertz(megahertz),
        .ticks(ticks), .ticks_rest(ticks_rest), .memory_data(memory_data),
        .memory_address(memory_address), .memory_write(memory_write),
        .memory_sample(memory_sample), .send(send), .data(data));
    (* hierconn *) wire [7:0] \dut.command_q ;
    (* hierconn *) wire [31:0] \dut.arguments_q ;
    (* hierconn *) wire [2:0] \dut.missing_q ;
    (* hierconn *) wire [23:0] \dut.divider_q ;
    (* hierconn *) wire [9:0] \dut.total_q ;
    (* hierconn *) wire [9:0] \dut.after_q ;
    (* hierconn *) wire [7:0] \dut.mask_q ;
    (* hierconn *) wire [7:0] \dut.value_q ;
    (* hierconn *) wire [2:0] \dut.phase_q ;
    (* hierconn *) wire [12:0] \dut.samples_left_q ;
    (* hierconn *) wire [23:0] \dut.ticks_left_q ;
    (* hierconn *) wire [6:0] \dut.fraction_q ;
    (* hierconn *) wire \dut.telling_q ;
    (* hierconn *) wire [4:0] \dut.place_q ;

    // What is heard: a command of one byte, or the last of the four behind one.
    wire begins = received && \dut.missing_q == 0;
    wire short_command = begins && received_byte < 8'h80;
    wire resets = short_command && received_byte == 8'h00;
    wire runs = short_command && received_byte == 8'h01;
    wire whole = received && \dut.missing_q == 1;
    wire [31:0] arguments = {received_byte, \dut.arguments_q [31:8]};

    // Ticks of a clock, and whether that of the next sample is among them.
    wire [7:0] fractions = {1'b0, \dut.fraction_q } + {1'b0, ticks_rest};
    wire carries = fractions >= {1'b0, megahertz};
    wire [4:0] ticks_now = {1'b0, ticks} + {4'd0, carries};
    wire running = \dut.phase_q == 1 || \dut.phase_q == 2;
    wire due = running && \dut.ticks_left_q < {19'd0, ticks_now};
    wire [25:0] further = {2'd0, \dut.ticks_left_q } + {2'd0, \dut.divider_q } + 26'd1;
    wire [25:0] now_wide = {21'd0, ticks_now};
    wire [25:0] left = due ? (further < now_wide ? 26'd0 : further - now_wide)
        : {2'd0, \dut.ticks_left_q } - now_wide;
    wire fits = (memory_sample & \dut.mask_q ) == ( \dut.value_q & \dut.mask_q );
    wire tells = \dut.telling_q && ready;
    wire gives = \dut.phase_q == 5 && ready && !\dut.telling_q ;

    // The line.
    always @* begin
        assert (memory_write == due);
        assert (send == (tells || gives));
        if (gives) assert (data == memory_data);
    end

    // Answers: `1ALS`, and metadata by the protocol's keys.
    function [7:0] answer(input [4:0] place, input [31:0] hertz);
        case (place)
            0: answer = "1";
            1: answer = "A";
            2: answer = "L";
            3: answer = "S";
            4: answer = 8'h01;
            5: answer = "h";
            6: answer = "e";
            7: answer = "l";
            8: answer = "i";
            9: answer = "x";
            10: answer = "l";
            11: answer = "o";
            12: answer = "c";
            13: answer = "k";
            15: answer = 8'h21;
            18: answer = 8'h10;
            20: answer = 8'h23;
            21: answer = hertz[31:24];
            22: answer = hertz[23:16];
            23: answer = hertz[15:8];
            24: answer = hertz[7:0];
            25: answer = 8'h40;
            26: answer = 8'h08;
            27: answer = 8'h41;
            28: answer = 8'h02;
            default: answer = 8'h00;
        endcase
    endfunction
    always @* if (tells) assert (data == answer( \dut.place_q , rate));

    // What was a clock ago.
    reg known = 0;
    reg [1:0] age = 0;
    reg was_cleared, was_reset, was_run, was_long, was_argument, was_whole, was_due, was_fitting;
    reg was_telling, was_tells, was_gives, was_identify, was_metadata, was_running;
    reg [7:0] probes_1, probes_2, command, byte_before, mask, value;
    reg [31:0] came;
    reg [2:0] missing, phase;
    reg [23:0] divider;
    reg [9:0] total, after;
    reg [12:0] samples;
    reg [11:0] address;
    reg [25:0] left_then;
    reg [7:0] fraction_then;
    reg [4:0] place;
    always @(posedge clock) begin
        if (clear) known <= 1;
        if (age != 2) age <= age + 1;
        {probes_2, probes_1} <= {probes_1, probes};
        was_cleared <= clear;
        was_reset <= resets;
        was_run <= runs;
        was_long <= begins && received_byte[7];
        was_argument <= received && \dut.missing_q != 0;
        was_whole <= whole;
        was_due <= due;
        was_fitting <= fits;
        was_running <= running;
        was_telling <= \dut.telling_q ;
        was_tells <= tells;
        was_gives <= gives;
        was_identify <= short_command && received_byte == 8'h02;
        was_metadata <= short_command && received_byte == 8'h04;
        byte_before <= received_byte;
        came <= arguments;
        command <= \dut.command_q ;
        missing <= \dut.missing_q ;
        phase <= \dut.phase_q ;
        divider <= \dut.divider_q ;
        total <= \dut.total_q ;
        after <= \dut.after_q ;
        mask <= \dut.mask_q ;
        value <= \dut.value_q ;
        samples <= \dut.samples_left_q ;
        address <= memory_address;
        left_then <= left;
        fraction_then <= carries ? fractions - {1'b0, megahertz} : fractions;
        place <= \dut.place_q ;
    end

    always @* if (age == 2) assert (memory_sample == probes_2);

    // Commands, and what they set.
    always @* if (known && was_cleared) begin
        assert ( \dut.missing_q == 0 && \dut.phase_q == 0 && !\dut.telling_q );
        assert ( \dut.divider_q == 0 && \dut.total_q == 0 && \dut.after_q == 0);
        assert ( \dut.mask_q == 0 && \dut.value_q == 0);
        assert (!memory_write && !send);
    end
    always @* if (known) assert ( \dut.missing_q <= 4 && \dut.phase_q <= 5);
    always @* if (known && !was_cleared) begin
        if (was_long) assert ( \dut.missing_q == 4 && \dut.command_q == byte_before);
        else assert ( \dut.command_q == command);
        if (was_argument) assert ( \dut.missing_q == missing - 3'd1 && \dut.arguments_q == came);
        if (!was_long && !was_argument) assert ( \dut.missing_q == missing);
        assert ( \dut.divider_q == (was_whole && command == 8'h80 ? came[23:0] : divider));
        assert ( \dut.total_q == (was_whole && command == 8'h81 ? came[9:0] : total));
        assert ( \dut.after_q == (was_whole && command == 8'h81 ? came[25:16] : after));
        assert ( \dut.mask_q == (was_whole && command == 8'hc0 ? came[7:0] : mask));
        assert ( \dut.value_q == (was_whole && command == 8'hc1 ? came[7:0] : value));
    end

    // The capture.
    wire [12:0] all_of_them = {1'b0, total, 2'b00} + 13'd4;
    wire [12:0] behind = {1'b0, after, 2'b00} + 13'd4;
    wire [9:0] ahead = total - after;
    always @* if (known && !was_cleared) begin
        if (was_run) begin
            assert ( \dut.phase_q == 1 && \dut.ticks_left_q == 0 && \dut.fraction_q == 0);
            assert ( \dut.samples_left_q == {1'b0, ahead, 2'b00});
        end else if (was_reset) assert ( \dut.phase_q == 0);
        else if (was_due && phase == 1 && samples != 0)
            assert ( \dut.phase_q == 1 && \dut.samples_left_q == samples - 13'd1);
        else if (was_due && phase == 1 && !was_fitting)
            assert ( \dut.phase_q == 1 && \dut.samples_left_q == 0);
        else if (was_due && phase == 1)
            assert ( \dut.phase_q == 2 && \dut.samples_left_q == behind);
        else if (was_due && samples != 1)
            assert ( \dut.phase_q == 2 && \dut.samples_left_q == samples - 13'd1);
        else if (was_due) assert ( \dut.phase_q == 3 && \dut.samples_left_q == all_of_them);
        else if (was_gives && samples != 1)
            assert ( \dut.phase_q == 3 && \dut.samples_left_q == samples - 13'd1);
        else if (was_gives) assert ( \dut.phase_q == 0);
        else if (phase == 3 || phase == 4)
            assert ( \dut.phase_q == phase + 3'd1 && \dut.samples_left_q == samples);
        else assert ( \dut.phase_q == phase && \dut.samples_left_q == samples);
        if (was_due) assert (memory_address == address + 12'd1);
        else if (phase == 3) assert (memory_address == address - 12'd1);
        else assert (memory_address == address);
        if (was_running && !was_run) begin
            assert ( \dut.ticks_left_q == left_then[23:0]);
            assert ( \dut.fraction_q == fraction_then[6:0]);
        end
    end

    // Answers go on byte by byte, to the end of what was asked for.
    wire ends = was_tells && (place == 3 || place == 29);
    always @* if (known && !was_cleared) begin
        if (was_identify) assert ( \dut.telling_q && \dut.place_q == 0);
        else if (was_metadata) assert ( \dut.telling_q && \dut.place_q == 4);
        else if (was_reset) assert (!\dut.telling_q );
        else begin
            assert ( \dut.telling_q == (was_telling && !ends));
            if (was_tells) assert ( \dut.place_q == place + 5'd1);
            else assert ( \dut.place_q == place);
        end
    end

    always @* cover (known && gives && data == 8'h55);
    always @* cover (known && tells && \dut.place_q == 3);
endmodule
