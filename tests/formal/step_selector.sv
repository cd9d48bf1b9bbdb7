// A step is asked for at a tick only, and then by the playback, the loop, or one press of the panel.

module step_selector_proof(
    input clock, input clear, input tick, input correcting, input automatic_forward,
    input manual_enable, input manual_step, input manual_forward, input playback
);
    wire request, forward;
    step_selector dut(.clock(clock), .clear(clear), .tick(tick), .correcting(correcting),
        .automatic_forward(automatic_forward), .manual_enable(manual_enable),
        .manual_step(manual_step), .manual_forward(manual_forward), .playback(playback),
        .request(request), .forward(forward));

    // A press that has not had its tick.
    reg waits;
    reg known = 0;
    always @(posedge clock) begin
        if (clear) known <= 1;
        if (clear || playback || !manual_enable) waits <= 0;
        else if (manual_step) waits <= 1;
        else if (tick) waits <= 0;
    end

    always @* begin
        if (!tick) assert (!request);
        if (tick && (playback || correcting)) assert (request);
        if (correcting) assert (forward == automatic_forward);
    end
    always @* if (known && !playback && !correcting) begin
        assert (request == (tick && waits && manual_enable));
        if (request) assert (forward == manual_forward);
    end

    always @* cover (known && request && !playback && !correcting);
endmodule
