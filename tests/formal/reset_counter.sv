// The count is the steps forward less the steps back, never beyond 4095; zero line, fault and
// playback are true to it.

module reset_counter_proof(
    input clock, input clear, input request, input forward, input playback
);
    wire step, drive_forward, count_forward, zero, fault;
    wire [11:0] count;
    reset_counter dut(.clock(clock), .clear(clear), .request(request), .forward(forward),
        .playback(playback), .step(step), .drive_forward(drive_forward), .count(count),
        .count_forward(count_forward), .zero(zero), .fault(fault));

    wire signed [13:0] magnitude = $signed({2'b00, count});
    wire signed [13:0] shown = count_forward ? magnitude : -magnitude;
    reg signed [13:0] position;
    wire signed [13:0] next = drive_forward ? position + 14'sd1 : position - 14'sd1;
    reg known = 0;
    reg refused;
    wire refuses = request && !clear && (next > 4095 || next < -4095);
    always @(posedge clock) begin
        if (clear) known <= 1;
        if (clear) position <= 0;
        else if (step) position <= next;
        if (clear || position == 0) refused <= 0;
        else if (refuses) refused <= 1;
    end

    always @* begin
        if (step) assert (request && !clear);
        if (!playback) assert (drive_forward == forward);
    end
    always @* if (known) begin
        assert (position <= 4095 && position >= -4095);
        assert (shown == position);
        assert (zero == (position == 0));
        assert (fault == refused);
        if (playback) begin
            // Nearer to zero, and none at zero.
            if (step) assert (position > 0 ? !drive_forward : drive_forward);
            if (position == 0) assert (!step);
            else if (request && !clear) assert (step);
        end else if (request && !clear) assert (step == !refuses);
    end

    always @* cover (known && position == 2 && !forward && playback && step);
    always @* cover (known && position == -2);
    always @* cover (known && playback && request && zero && !step);
endmodule
