// Pulses out are pulses in, one more or one less for every correction due: none lost or doubled.

module cumulative_compensator_proof(
    input clock, input clear, input laser, input [15:0] preset, input insert
);
    wire pulse;
    cumulative_compensator dut(.clock(clock), .clear(clear), .laser(laser), .preset(preset),
        .insert(insert), .pulse(pulse));

    (* hierconn *) wire \dut.owed_q ;
    (* hierconn *) wire \dut.divider_due ;
    (* hierconn *) wire [3:0] \dut.divider.units.state_q ;
    (* hierconn *) wire [3:0] \dut.divider.tens.state_q ;
    (* hierconn *) wire [3:0] \dut.divider.hundreds.state_q ;
    (* hierconn *) wire [3:0] \dut.divider.thousands.state_q ;
    (* hierconn *) wire [3:0] \dut.divider.ten_thousands.state_q ;
    (* hierconn *) wire [3:0] \dut.divider.hundred_thousands.state_q ;
    (* hierconn *) wire [3:0] \dut.divider.millions.state_q ;
    wire low_count = \dut.divider.units.state_q <= 1 && \dut.divider.tens.state_q == 0
        && \dut.divider.hundreds.state_q == 0 && \dut.divider.thousands.state_q == 0
        && \dut.divider.ten_thousands.state_q == 0 && \dut.divider.hundred_thousands.state_q == 0
        && \dut.divider.millions.state_q == 0;

    // Pulses out less pulses in less corrections due: what is still owed.
    reg signed [7:0] balance;
    wire signed [7:0] correction = \dut.divider_due ? (insert ? 8'sd1 : -8'sd1) : 8'sd0;
    wire signed [7:0] change = $signed({7'd0, pulse}) - $signed({7'd0, laser}) - correction;
    reg known = 0;
    reg had_laser, was_insert;
    reg [15:0] wheels;
    always @* begin
        // What the input synchroniser guarantees, and the panel: switches rest during a pass.
        if (known) assume (!(laser && had_laser));
        assume (preset[3:0] <= 9 && preset[7:4] <= 9 && preset[11:8] <= 9 && preset[15:12] <= 9);
        if (known && !clear) assume (insert == was_insert && preset == wheels);
    end
    always @(posedge clock) begin
        if (clear) known <= 1;
        had_laser <= laser && !clear;
        was_insert <= insert;
        wheels <= preset;
        balance <= clear ? 0 : balance + change;
    end

    always @* if (known && !clear) begin
        assert (balance == (\dut.owed_q ? (insert ? -8'sd1 : 8'sd1) : 8'sd0));
        // So there is never a second correction due while one is owed.
        if ( \dut.owed_q ) assert (low_count);
        assert (!( \dut.owed_q && \dut.divider_due ));
        // An inserted pulse waits one clock at most.
        if (insert && \dut.owed_q ) assert (had_laser || !laser);
    end

    always @* cover (known && insert && \dut.owed_q );
    always @* cover (known && !insert && \dut.owed_q && laser);
endmodule
