// The pin is low for 64 clocks after a step, then high for 64, its direction steady all along.

module step_driver_proof(input clock, input clear, input step, input forward);
    wire step_pin, direction_pin;
    step_driver dut(.clock(clock), .clear(clear), .step(step), .forward(forward),
        .step_pin(step_pin), .direction_pin(direction_pin));

    (* hierconn *) wire [7:0] \dut.left_q ;
    // Clocks since the last step, to 129.
    reg [7:0] since;
    reg direction;
    reg known = 0;
    always @(posedge clock) begin
        if (clear) known <= 1;
        if (clear) since <= 129;
        else if (step) since <= 1;
        else if (since < 129) since <= since + 1;
        if (clear) direction <= 0;
        else if (step) direction <= forward;
    end

    always @* if (known) begin
        assert (since >= 1 && since <= 129);
        assert ( \dut.left_q == 129 - since);
        assert (step_pin == (since >= 65 && since <= 128));
        assert (direction_pin == direction);
    end

    always @* cover (known && step && since < 129);
endmodule
