#!/usr/bin/env perl
# Checks the English of pages, help texts, messages and comments against the list in cmake/words.txt. Prints each find as
# file:line:column with the better words. Usage: check_words.pl [checkout]
use strict;
use warnings;
use utf8;
use open qw(:std :encoding(UTF-8));
use File::Basename;
use File::Find;

chdir($ARGV[0] // dirname(__FILE__) . "/..") or die;
my $longest = 25;               # words of a sentence on a page
my @labBooks = ('docs/developers/performance.md');  # whose sentences may be longer

# Each line of the list: where it holds, the phrase (a regular expression), and the better words.
my (%patterns, @rules);
open(my $list, '<', 'cmake/words.txt') or die "cmake/words.txt: $!\n";
while (<$list>) {
  chomp;
  next if /^#/ || /^\s*$/;
  my ($where, $phrase, $better) = split /\s+\|\s+/, $_, 3;
  die "cmake/words.txt:$.: expected WHERE | PHRASE | BETTER WORDS\n"
    unless defined $better && $where =~ /^(all|page|comment|opening)$/;
  push @rules, {where => $where, phrase => $phrase, better => $better};
}
# One expression for all, so that most text is read once; which rule it was is asked only of finds.
sub joined { my %kinds = map { $_ => 1 } @_; my $all = join '|', map { $_->{phrase} } grep { $kinds{$_->{where}} } @rules; qr/\b(?:$all)/ }
%patterns = (page => joined('all', 'page'), comment => joined('all', 'comment'), string => joined('all'));

my ($texts, $finds) = (0, 0);

sub report {
  my ($file, $pieces, $at, $what, $better) = @_;
  my ($line, $column) = (0, 0);
  for my $piece (@$pieces) {
    last if $piece->[0] > $at;
    ($line, $column) = ($piece->[1], $piece->[2] + $at - $piece->[0]);
  }
  $what =~ s/\s+/ /g;
  print "$file:$line:$column: \"$what\": $better\n";
  $finds++;
}

# One paragraph, comment or message. Its pieces are [offset in the text, line, column].
sub check {
  my ($file, $kind, $text, $pieces) = @_;
  $texts++;
  $text =~ s/\s/ /g;
  my $small = lc $text;
  while ($small =~ /$patterns{$kind}/g) {
    my ($at, $what) = ($-[0], $&);
    my ($rule) = grep { substr($small, $at) =~ /^(?:$_->{phrase})/ && ($_->{where} eq 'all' || $_->{where} eq $kind) } @rules;
    report($file, $pieces, $at, $what, $rule->{better});
  }
  if ($kind ne 'string') {
    my $begin = $kind eq 'page' && $text =~ /^\s*(?:(?:[*-]|\d+\.)\s+)?/ ? $+[0] : 0;
    for my $rule (grep { $_->{where} eq 'opening' } @rules) {
      report($file, $pieces, $begin, $&, $rule->{better}) if substr($text, $begin) =~ /^(?:$rule->{phrase})/;
    }
  }
  return unless $kind eq 'page' && !grep { $file eq $_ } @labBooks;
  my $plain = $text =~ s/\([^()]*\)/' ' x length $&/ger;  # what stands in brackets has a length of its own
  while ($plain =~ /(.+?)(?:[.!?:;](?=[\s)*"]|$)|$)/gs) {
    my ($at, $sentence) = ($-[1], $1);
    my $words = grep { /\w/ && !/^`x+`\S{0,2}$/ } split ' ', $sentence;  # names in code do not count
    $at += length $1 if $sentence =~ /^(\s+)/;
    report($file, $pieces, $at, substr($sentence =~ s/^\s+//r, 0, 40) . ' ...', "$words words; at most $longest") if $words > $longest;
  }
}

# Pages: paragraphs, items of lists, cells of tables. Code and addresses of links are blanked.
sub checkPage {
  my ($file) = @_;
  open(my $in, '<', $file) or die "$file: $!\n";
  my ($text, @pieces, $inCode) = ('');
  my $flush = sub { check($file, 'page', $text, [@pieces]) if $text =~ /\S/; $text = ''; @pieces = () };
  my $add = sub { my ($part, $line, $column) = @_; push @pieces, [length $text, $line, $column]; $text .= "$part " };
  while (my $line = <$in>) {
    chomp $line;
    $inCode = !$inCode, next if $line =~ /^```/;
    $line =~ s/`[^`]*`/'`' . 'x' x (length($&) - 2) . '`'/ge;
    $line =~ s/(\])(\([^)\s]*\))/$1 . ' ' x length $2/ge;
    $line =~ s/<[^>]*>/' ' x length $&/ge;
    if ($inCode || $line =~ /^(    |\s*$|#|!\[)/) {
      $flush->();
      $add->($line, $., 1), $flush->() if $line =~ /^#/;
    } elsif ($line =~ /^\|/) {
      $flush->();
      while ($line =~ /([^|]+)/g) { $add->($1, $., $-[1] + 1); $flush->() }
    } else {
      $flush->() if $line =~ /^\s*([*-]|\d+\.) /;
      $add->($line, $., 1);
    }
  }
  $flush->();
}

# Sources: comments, of which neighbouring lines are one, and string literals, of which neighbours are one as well.
sub checkSource {
  my ($file) = @_;
  open(my $in, '<', $file) or die "$file: $!\n";
  my $source = do { local $/; <$in> };
  my ($line, $begin, $done) = (1, 0, 0);
  my %open = map { $_ => {text => '', pieces => [], end => -1, last => -1} } 'comment', 'string';
  my $flush = sub {
    my ($kind) = @_;
    my $o = $open{$kind};
    check($file, $kind, $o->{text}, $o->{pieces}) if $o->{text} =~ /\w\s+\w/;
    @$o{'text', 'pieces'} = ('', []);
  };
  while ($source =~ m{R"(\w*)\((.*?)\)\1"|"((?:[^"\\\n]|\\.)*)"|'(?:[^'\\\n]|\\.)+'|//[/!]*<? ?([^\n]*)|/\*(.*?)\*/}gs) {
    my ($at, $end) = ($-[0], $+[0]);
    my ($kind, $text, $first) =
      defined $2 ? ('string', $2, $-[2]) : defined $3 ? ('string', $3, $-[3]) :
      defined $4 ? ('comment', $4, $-[4]) : defined $5 ? ('comment', $5, $-[5]) : next;
    $line += substr($source, $done, $at - $done) =~ tr/\n//;
    $begin = rindex($source, "\n", $at) + 1;
    my $inLine = $line + (substr($source, $at, $first - $at) =~ tr/\n//);
    $done = $at;
    my $o = $open{$kind};
    my $between = $o->{end} < 0 ? 'x' : substr($source, $o->{end}, $at - $o->{end});
    my $alone = substr($source, $begin, $at - $begin) =~ /^\s*$/;
    # A comment on a line of its own goes on with that of the line before, if that one began its line as well.
    my $goesOn = $between =~ /^\s*$/ && ($kind eq 'string' || ($alone && $o->{alone} && ($between =~ tr/\n//) == 1));
    $flush->($kind) unless $goesOn;
    push @{$o->{pieces}}, [length $o->{text}, $inLine, $first - $begin + 1];
    $o->{text} .= $kind eq 'comment' ? "$text " : $text;
    @$o{'end', 'alone'} = ($end, $alone);
  }
  $flush->($_) for 'comment', 'string';
}

# Scripts, scenes and build files: their comments.
sub checkScript {
  my ($file, $sign) = @_;
  open(my $in, '<', $file) or die "$file: $!\n";
  my ($text, @pieces) = ('');
  while (my $line = <$in>) {
    if ($line =~ /^\s*$sign+!? ?(.*)/) {
      push @pieces, [length $text, $., $-[1] + 1];
      $text .= "$1 ";
    } else {
      check($file, 'comment', $text, [@pieces]) if $text =~ /\S/;
      ($text, @pieces) = ('');
      check($file, 'comment', $1, [[0, $., $-[1] + 1]]) if $line =~ /\s$sign+ (.*)/;
    }
  }
  check($file, 'comment', $text, [@pieces]) if $text =~ /\S/;
}

my @files;
find({no_chdir => 1, wanted => sub { push @files, $File::Find::name if -f }}, grep { -d } 'docs', 'src', 'bench', 'scenes', 'cmake', 'editors');
push @files, grep { -f } glob('*.md'), 'dev', 'CMakeLists.txt', 'tests/CMakeLists.txt';
for my $file (sort @files) {
  next if $file =~ m{^cmake/(words\.txt|check_words\.pl)$};
  if ($file =~ /\.md$/) { checkPage($file) }
  elsif ($file =~ m{^(src|bench)/.*\.(h|cpp)$}) { checkSource($file) }
  elsif ($file =~ /\.(sh|cmake|py)$|^dev$|CMakeLists\.txt$/) { checkScript($file, '#') }
  elsif ($file =~ m{^scenes/[^/]*\.ray$}) { checkScript($file, '//') }
}
printf "%d phrases, %d texts, %d finds\n", scalar @rules, $texts, $finds;
exit($finds > 0 || $texts == 0 || @rules == 0);
