// High between a grating pulse and the next laser pulse exactly; low while held; a coincidence
// changes nothing.

module phase_meter_proof(input clock, input hold, input grating, input laser);
    wire meter;
    phase_meter dut(.clock(clock), .hold(hold), .grating(grating), .laser(laser), .meter(meter));

    // Which of the two came last, alone.
    reg grating_last;
    reg known = 0;
    always @(posedge clock) begin
        if (hold) known <= 1;
        if (hold) grating_last <= 0;
        else if (grating != laser) grating_last <= grating;
    end

    always @* if (known) assert (meter == grating_last);

    always @* cover (known && meter && grating && laser);
    always @* cover (known && !meter && grating_last == 0 && laser);
endmodule
