/* E_k and Var_k of strategy 2 with PARI/GP: hypergeom with guard digits, then formula 2.104, which loses 2 log10 k
   of them.

     echo 'tool_version()' | gp -q -f -s 256M pari.gp
     echo 'tool_points([K,K,...], [D,D,...])' | gp -q -f -s 256M pari.gp

   The lines: point JOB K D SECONDS VALUE   (JOB: E or V).
   Seconds are time by the clock of a call, best of several rounds; the clock counts milliseconds, so that a round
   takes at least 30. Where hypergeom raises there is no line. */

/* Photon k is the l-th of the m of its shell. */
place(k) = {my(m = (1 + sqrtint(8*k - 7))\2); [m, k - m*(m - 1)/2]};

value(job, k) = {
  my(m, l, f, inner);
  [m, l] = place(k);
  inner = m*(m - 1)/2;
  f = hypergeom([1, l], m + 1, -2./(m - 1));
  if(job == "E", return(f*k/inner));
  ((inner*m - (inner*(m - 1) + (l - 1)*m)*f)/(inner + m) - f^2)*(k/inner)^2;
}

guarded(job, k, digits) = {
  localprec(digits + 2 + if(job == "V", 2*logint(k, 10) + 2, 0));
  value(job, k);
}

/* Milliseconds that `calls` calls take. */
spent(calls, job, k, digits) = {
  my(start = getwalltime());
  for(i = 1, calls, guarded(job, k, digits));
  getwalltime() - start;
}

seconds(job, k, digits) = {
  my(calls = 1, best);
  while((best = spent(calls, job, k, digits)) < 30, calls *= 2);
  if(best < 100, for(i = 1, 3, best = min(best, spent(calls, job, k, digits))));
  best/calls/1000.;
}

/* Without the space before the exponent. */
text(number, digits) = strjoin(strsplit(strprintf(Str("%.", digits, "e"), number), " "));

tool_point(job, k, digits) = {iferr(
  my(cost = text(seconds(job, k, digits), 3), answer = text(guarded(job, k, digits), digits + 5));
  print(strjoin(["point", job, k, digits, cost, answer], " ")),
  error, warning("no value: ", job, " ", k, " ", digits, " ", error))};

tool_points(photons, targets) = {
  foreach(photons, k, foreach(targets, digits, foreach(["E", "V"], job, tool_point(job, k, digits))));
}

tool_version() = print(strjoin(apply(n -> Str(n), version()[1..3]), "."));
