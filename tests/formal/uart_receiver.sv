// A byte is taken from the middle of its eight bits, after a start bit that is low in its middle and
// before a stop bit that is high; anything else is none.

module uart_receiver_proof(input clock, input clear, input [11:0] bit_clocks, input line);
    wire received;
    wire [7:0] data;
    uart_receiver dut(.clock(clock), .clear(clear), .bit_clocks(bit_clocks), .line(line),
        .received(received), .data(data));
    (* hierconn *) wire \dut.low ;
    (* hierconn *) wire [7:0] \dut.shift_q ;
    (* hierconn *) wire [3:0] \dut.bits_left_q ;
    (* hierconn *) wire [11:0] \dut.clocks_left_q ;

    // The wire, two clocks late.
    reg [1:0] age = 0;
    reg line_1, line_2;
    always @(posedge clock) begin
        if (age != 2) age <= age + 1;
        {line_2, line_1} <= {line_1, line};
    end
    always @* if (age == 2) assert (\dut.low == !line_2);

    // The byte under way: the bit that is looked at next, and clocks until then.
    reg known = 0;
    reg busy;
    reg [3:0] place;
    reg [11:0] left;
    reg [7:0] bits;
    wire looks = busy && left == 1;
    always @(posedge clock) begin
        if (clear) begin
            known <= 1;
            busy <= 0;
        end else if (known && !busy && \dut.low ) begin
            busy <= 1;
            place <= 0;
            left <= bit_clocks / 2;
        end else if (known && looks) begin
            busy <= place == 0 ? \dut.low : place != 9;
            place <= place + 1;
            left <= bit_clocks;
            if (place != 0 && place != 9) bits[place - 1] <= !\dut.low ;
        end else if (known && busy) left <= left - 1;
    end

    // The speed is set once.
    reg [11:0] speed;
    reg running = 0;
    always @(posedge clock) begin
        speed <= bit_clocks;
        running <= 1;
    end
    always @* assume (bit_clocks >= 2);
    always @* if (running) assume (bit_clocks == speed);

    always @* if (known) begin
        assert (received == (looks && place == 9 && !\dut.low ));
        if (received) assert (data == bits);
    end
    wire [7:0] taken = (8'h01 << (place - 1)) - 8'h01;
    always @* if (known && busy) begin
        assert (place <= 9);
        assert (left >= 1 && left <= bit_clocks);
        assert (\dut.bits_left_q == 10 - place);
        assert (\dut.clocks_left_q == left);
        if (place != 0) assert ((\dut.shift_q >> (9 - place)) == (bits & taken));
    end
    always @* if (known && !busy) assert (\dut.bits_left_q == 0);

    always @* cover (known && received && data == 8'h05);
endmodule
