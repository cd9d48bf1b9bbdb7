// scale_lookup: Finds the correction of a place in the EEPROM and steps the corrector to it
// | (document 3)

`default_nettype none

module scale_lookup (
    input  wire         clock,
    input  wire         clear,
    input  wire         origin,
    input  wire         place_pulse,
    input  wire         forward,
    input  wire         machining,
    input  wire [11:0]  places,
    input  wire         two_ways,
    input  wire [23:0]  scale,
    input  wire         tick,
    input  wire [7:0]   data,
    output wire [11:0]  address,
    output wire [7:0]   correction,
    output wire         step,
    output wire         step_forward
);

    wire [11:0] place_more;
    wire [11:0] place_less;
    wire [11:0] forward_address;
    wire [11:0] reverse_address;
    reg [11:0] wanted;
    wire [4:0] phase_more;
    wire [7:0] negated;
    wire [23:0] doubled;
    wire [23:0] sum;
    wire [23:0] rounded;
    wire [11:0] above_middle;
    wire [11:0] below_middle;
    wire up;
    wire moving;
    wire [11:0] stands_more;
    wire [11:0] stands_less;
    reg [11:0] place_d;
    reg [11:0] place_q;
    wire [11:0] pointer_d;
    reg [11:0] pointer_q;
    wire inside_d;
    reg inside_q;
    reg [4:0] phase_d;
    reg [4:0] phase_q;
    reg [7:0] byte_d;
    reg [7:0] byte_q;
    reg [23:0] factor_d;
    reg [23:0] factor_q;
    reg [7:0] digits_d;
    reg [7:0] digits_q;
    reg [23:0] product_d;
    reg [23:0] product_q;
    reg [11:0] target_d;
    reg [11:0] target_q;
    reg [11:0] stands_d;
    reg [11:0] stands_q;

    assign place_more = place_q + 12'h1;
    assign place_less = place_q - 12'h1;

    always @* begin
        place_d = place_q;
        if (clear | origin) begin
            place_d = 12'h0;
        end else if (place_pulse & forward) begin
            place_d = place_more;
        end else if (place_pulse) begin
            place_d = place_less;
        end
    end

    assign forward_address = place_q + 12'h10;
    assign reverse_address = forward_address + places;

    always @* begin
        if (two_ways & ~forward) begin
            wanted = reverse_address;
        end else begin
            wanted = forward_address;
        end
    end

    assign pointer_d = wanted;
    assign inside_d = place_q < places;
    assign phase_more = phase_q + 5'h1;

    always @* begin
        phase_d = phase_q;
        if (clear | (pointer_q != wanted)) begin
            phase_d = 5'h0;
        end else if (phase_q < 5'h1a) begin
            phase_d = phase_more;
        end
    end

    assign negated = ~data + 8'h1;
    assign doubled = factor_q << 24'h1;
    assign sum = product_q + factor_q;

    always @* begin
        byte_d = byte_q;
        factor_d = factor_q;
        digits_d = digits_q;
        product_d = product_q;
        if (phase_q == 5'hf) begin
            product_d = 24'h0;
            factor_d = scale;
            if (~inside_q) begin
                byte_d = 8'h0;
                digits_d = 8'h0;
            end else if (data[7]) begin
                byte_d = data;
                digits_d = negated;
            end else begin
                byte_d = data;
                digits_d = data;
            end
        end else if (phase_q < 5'h18) begin
            factor_d = doubled;
            digits_d = {1'b0, digits_q[7:1]};
            if (digits_q[0]) begin
                product_d = sum;
            end
        end
    end

    assign rounded = product_q + 24'h800;
    assign above_middle = rounded[23:12] + 12'h800;
    assign below_middle = ~rounded[23:12] + 12'h801;
    assign stands_more = stands_q + 12'h1;
    assign stands_less = stands_q - 12'h1;
    assign up = stands_q < target_q;
    assign moving = tick & machining & ~clear & (stands_q != target_q);

    always @* begin
        target_d = target_q;
        stands_d = stands_q;
        if (clear) begin
            target_d = 12'h800;
            stands_d = 12'h800;
        end else begin
            if ((phase_q == 5'h18) & byte_q[7]) begin
                target_d = below_middle;
            end else if (phase_q == 5'h18) begin
                target_d = above_middle;
            end
            if (moving & up) begin
                stands_d = stands_more;
            end else if (moving) begin
                stands_d = stands_less;
            end
        end
    end

    assign address = pointer_q;
    assign correction = byte_q;
    assign step = moving;
    assign step_forward = up;

    initial begin
        place_q = 12'h0;
        pointer_q = 12'h0;
        inside_q = 1'b0;
        phase_q = 5'h0;
        byte_q = 8'h0;
        factor_q = 24'h0;
        digits_q = 8'h0;
        product_q = 24'h0;
        target_q = 12'h0;
        stands_q = 12'h0;
    end

    always @(posedge clock) begin
        place_q <= place_d;
        pointer_q <= pointer_d;
        inside_q <= inside_d;
        phase_q <= phase_d;
        byte_q <= byte_d;
        factor_q <= factor_d;
        digits_q <= digits_d;
        product_q <= product_d;
        target_q <= target_d;
        stands_q <= stands_d;
    end

    // Without a reader here; named so that linters know it is meant.
    wire unused_bits = &{1'b0, rounded[11:0]};
endmodule

`default_nettype wire
