// A byte is a start bit, its eight bits from the lowest and a stop bit, each as long as the others;
// at rest the line is high.

module uart_transmitter_proof(
    input clock, input clear, input [11:0] bit_clocks, input send, input [7:0] data
);
    wire line, ready;
    uart_transmitter dut(.clock(clock), .clear(clear), .bit_clocks(bit_clocks), .send(send),
        .data(data), .line(line), .ready(ready));
    (* hierconn *) wire [8:0] \dut.shift_q ;
    (* hierconn *) wire [3:0] \dut.bits_left_q ;
    (* hierconn *) wire [11:0] \dut.clocks_left_q ;

    // The byte under way, the place of its bit, and clocks that this bit has lasted.
    reg known = 0;
    reg busy;
    reg [7:0] held;
    reg [3:0] place;
    reg [11:0] lasted;
    always @(posedge clock) begin
        if (clear) begin
            known <= 1;
            busy <= 0;
        end else if (known && !busy && send) begin
            busy <= 1;
            held <= data;
            place <= 0;
            lasted <= 1;
        end else if (known && busy && lasted == bit_clocks) begin
            busy <= place != 9;
            place <= place + 1;
            lasted <= 1;
        end else if (known && busy) lasted <= lasted + 1;
    end

    // The speed is set once.
    reg [11:0] speed;
    reg running = 0;
    always @(posedge clock) begin
        speed <= bit_clocks;
        running <= 1;
    end
    always @* assume (bit_clocks != 0);
    always @* if (running) assume (bit_clocks == speed);

    wire [9:0] whole = {1'b1, held, 1'b0};
    always @* if (known) begin
        assert (ready == !busy);
        if (!busy) assert (line);
        if (busy) assert (line == whole[place]);
    end
    always @* if (known && busy) begin
        assert (place <= 9);
        assert (lasted >= 1 && lasted <= bit_clocks);
        assert (\dut.bits_left_q == 10 - place);
        assert (\dut.clocks_left_q == bit_clocks - lasted + 1);
        assert (\dut.shift_q == ({~held, 1'b1} >> place));
    end
    always @* if (known && !busy) assert (\dut.shift_q == 0);

    always @* cover (known && busy && place == 9);
endmodule
