// Wider than the standard sets Q, narrower clears it, and nothing else changes it.

module direction_discriminator_proof(
    input clock, input clear, input hold, input meter, input standard
);
    wire cp1, cp2, q, q_bar, decided;
    direction_discriminator dut(.clock(clock), .clear(clear), .hold(hold), .meter(meter),
        .standard(standard), .cp1(cp1), .cp2(cp2), .q(q), .q_bar(q_bar), .decided(decided));

    wire wider = meter && !standard && !hold;
    wire narrower = !meter && standard && !hold;
    reg was_q, was_decided, was_wider, was_narrower, cleared, held;
    reg known = 0;
    always @(posedge clock) begin
        known <= 1;
        {was_q, was_decided, was_wider, was_narrower} <= {q, decided, wider, narrower};
        {cleared, held} <= {clear, hold};
    end

    always @* begin
        assert (q_bar == !q);
        assert (cp1 == !wider);
        assert (cp2 == !narrower);
        assert (cp1 || cp2);
    end
    always @* if (known) begin
        if (cleared) assert (!q);
        else if (was_wider) assert (q);
        else if (was_narrower) assert (!q);
        else assert (q == was_q);
        if (cleared || held) assert (!decided);
        else assert (decided == (was_decided || was_wider || was_narrower));
    end

    always @* cover (known && q && !was_q);
    always @* cover (known && !q && was_q && !cleared);
endmodule
