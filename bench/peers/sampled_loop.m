% The sampled loop with backlash of the built-in case, sample by sample, and its time per sample.
%
%   octave-cli sampled_loop.m [DURATION]
%
% prints the largest |z1| of the second half, as `holdfast sweep --metric steady_peak` does, and
% nanoseconds per sample.

arguments = argv();
duration = 20;
if numel(arguments) > 0
  duration = str2double(arguments{1});
end

% Kollar 2022, Table 1 and Section 4.2 (data/kollar2022.toml), SI units.
m1 = 0.0767; k1 = 50.3; c1 = 0.079;
m2 = 0.16;   k2 = 74.4; c2 = 4.0;
period = 0.001; width = 0.0005;
P = -557; D = -13;
amplitude = 0.5; frequency = 10;

A = [0, 1, 0, 0
     -(k1 + k2) / m1, -(c1 + c2) / m1, k2 / m1, c2 / m1
     0, 0, 0, 1
     k2 / m2, c2 / m2, -k2 / m2, -c2 / m2];
b = [0; 1 / m1; 0; -1 / m2];
c = [0; 1 / m1; 0; 0];

% Zero-order hold: exp([A b c; 0 0 0] tau) = [Ad Gamma cd; 0 I].
held = expm([A, b, c; zeros(2, 6)] * period);
Ad = held(1:4, 1:4);
control = held(1:4, 5);
excitation = held(1:4, 6);

samples = floor(duration / period * (1 + 1e-12)) + 1;
z = zeros(4, 1);
inside = false;
lower = 0;
upper = 0;
velocity_before = 0;
steady_peak = 0;
tic;
for j = 0:samples - 1
  distance = z(3) - z(1);
  velocity = z(4) - z(2);
  if inside
    inside = distance >= lower && distance <= upper;
  elseif velocity_before ~= 0 && velocity_before * velocity <= 0
    inside = true;
    if velocity_before > 0
      lower = distance - width;
      upper = distance;
    else
      lower = distance;
      upper = distance + width;
    end
  end
  velocity_before = velocity;
  u = 0;
  if ~inside
    u = P * z(1) + D * z(2);
  end
  if j * period >= duration / 2
    steady_peak = max(steady_peak, abs(z(1)));
  end
  z = Ad * z + control * u + excitation * (amplitude * cos(2 * pi * frequency * j * period));
end
seconds = toc;
printf('steady_peak %.15g m, %.0f ns per sample\n', steady_peak, seconds / samples * 1e9);
