// Drives the device in Icarus: clocks, pin changes, end state. Time is taken outside.

module bench;
reg clock = 0;
@PORTS@
device device(.clock(clock)@CONNECTIONS@);

integer file, found, pin, event_number;
reg [63:0] clocks, count, now, due, value;

task run_until(input [63:0] until_clock);
    while (now < until_clock) begin
        #1 clock = 1;
        #1 clock = 0;
        now = now + 1;
    end
endtask

task set_pin;
    case (pin)
@PINS@    endcase
endtask

reg [8*512:1] name;
initial begin
    if (!$value$plusargs("stimulus=%s", name)) $finish;
    file = $fopen(name, "r");
    now = 0;
    found = $fscanf(file, "%d %d", clocks, count);
    for (event_number = 0; event_number < count; event_number = event_number + 1) begin
        found = $fscanf(file, "%d %d %d", due, pin, value);
        run_until(due);
        set_pin;
    end
    run_until(clocks);
    #1 $display("state @FORMAT@", @STATE@);
    $finish;
end
endmodule
