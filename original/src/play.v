    $readmemh("stimuli.hex", stimuli);
    $dumpfile("edges.vcd");
    $dumpvars(1, device);
    for (number = 0; number < {}; number = number + 1) begin
      change = stimuli[number];
      if (change[63:16] != 0) #(change[63:16]);
      pins[change[15:1]] = change[0];
    end
    #{} $finish;
  end
endmodule
