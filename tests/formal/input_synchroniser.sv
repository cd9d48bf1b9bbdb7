// One clock high for every rising edge of the pin, two clocks later; never two clocks in a row.

module input_synchroniser_proof(input clock, input pin);
    wire rising;
    input_synchroniser dut(.clock(clock), .pin(pin), .rising(rising));

    reg [2:0] past;
    reg was_rising;
    reg [1:0] age = 0;
    always @(posedge clock) begin
        past <= {past[1:0], pin};
        was_rising <= rising;
        age <= (age == 3) ? age : age + 1;
    end

    always @* if (age == 3) begin
        assert (rising == (past[1] && !past[2]));
        assert (!(rising && was_rising));
    end

    always @* cover (age == 3 && rising);
endmodule
