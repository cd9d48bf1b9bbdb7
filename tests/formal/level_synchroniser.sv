// The level out is the pin of two clocks ago, whatever the flip-flops wake up as.

module level_synchroniser_proof(input clock, input pin);
    wire level;
    level_synchroniser dut(.clock(clock), .pin(pin), .level(level));

    reg [1:0] past;
    reg [1:0] age = 0;
    always @(posedge clock) begin
        past <= {past[0], pin};
        age <= (age == 2) ? age : age + 1;
    end

    always @* if (age == 2) assert (level == past[1]);

    always @* cover (age == 2 && level && !pin);
endmodule
