// The level changes only after the pin has stood otherwise for that many ticks, and then it does;
// off, the pin passes.

module input_conditioner_proof(
    input clock, input pin, input active_low, input tick, input [3:0] ticks
);
    wire level, steady;
    input_conditioner dut(.clock(clock), .pin(pin), .active_low(active_low), .tick(tick),
        .ticks(ticks), .level(level), .steady(steady));
    (* hierconn *) wire \dut.settled_q ;
    (* hierconn *) wire [3:0] \dut.stood_q ;

    // The pin as it is seen, two clocks late, and ticks that it stands otherwise than the level.
    reg [1:0] past;
    reg [1:0] age = 0;
    reg [3:0] stood;
    reg known = 0;
    reg settled;
    wire differs = past[1] != \dut.settled_q ;
    always @(posedge clock) begin
        past <= {past[0], pin ^ active_low};
        age <= (age == 2) ? age : age + 1;
        settled <= \dut.settled_q ;
        if (age == 2) begin
            if (!differs) begin
                known <= 1;
                stood <= 0;
            end else if (tick) stood <= (stood + 4'd1 >= ticks) ? 0 : stood + 1;
        end
    end

    // Settings rest.
    reg [3:0] ticks_before;
    reg running = 0;
    always @(posedge clock) begin
        ticks_before <= ticks;
        running <= 1;
    end
    always @* if (running) assume (ticks == ticks_before);

    always @* if (ticks == 0) assert (level == (pin ^ active_low));
    always @* if (ticks == 0 && age == 2) assert (steady == past[1]);
    always @* if (ticks != 0) assert (level == steady);
    always @* if (known) assert (\dut.stood_q == stood);

    // A change needs the last tick of enough of them, and the level the pin had.
    reg may;
    reg to;
    reg told = 0;
    always @(posedge clock) begin
        told <= age == 2;
        may <= differs && tick && (\dut.stood_q + 4'd1 >= ticks);
        to <= past[1];
    end
    always @* if (told && settled != \dut.settled_q ) assert (may);
    always @* if (told && may) assert (\dut.settled_q == to);

    always @* cover (known && ticks == 2 && level && !past[1]);
endmodule
