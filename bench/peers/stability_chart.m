% Chart of the stable gains (P, D) of the built-in case, by the eigenvalues of every cell.
%
%   octave-cli stability_chart.m FILE [P_COUNT [D_COUNT]]
%
% writes what `holdfast stability --p -1000:200:1000 --d -40:20:1000 --output FILE` does (counts as
% given), without its metadata.

arguments = argv();
if numel(arguments) < 1
  error('usage: octave-cli stability_chart.m FILE [P_COUNT [D_COUNT]]');
end
counts = [1000, 1000];
for k = 2:numel(arguments)
  counts(k - 1) = str2double(arguments{k});
end

% Kollar 2022, Table 1 and Section 4.2 (data/kollar2022.toml), SI units.
m1 = 0.0767; k1 = 50.3; c1 = 0.079;
m2 = 0.16;   k2 = 74.4; c2 = 4.0;
period = 0.001;

A = [0, 1, 0, 0
     -(k1 + k2) / m1, -(c1 + c2) / m1, k2 / m1, c2 / m1
     0, 0, 0, 1
     k2 / m2, c2 / m2, -k2 / m2, -c2 / m2];
b = [0; 1 / m1; 0; -1 / m2];

% Zero-order hold: exp([A b; 0 0] tau) = [Ad Gamma; 0 1]. Without processing delay the force of the
% sample before has no part in the step.
held = expm([A, b; zeros(1, 5)] * period);
Ad = held(1:4, 1:4);
present_force = held(1:4, 5);
previous_force = zeros(4, 1);

P = linspace(-1000, 200, counts(1));
D = linspace(-40, 20, counts(2));
table = zeros(numel(P) * numel(D), 3);
row = 0;
for p = P
  for d = D
    K = [p, d, 0, 0];
    S = [Ad + present_force * K, previous_force
         K, 0];
    row = row + 1;
    table(row, :) = [p, d, max(abs(eig(S))) < 1];
  end
end

file = fopen(arguments{1}, 'w');
fprintf(file, 'proportional_gain,differential_gain,stable\n');
fprintf(file, '%.17g,%.17g,%d\n', table');
fclose(file);
