import csv,sys
rows=list(csv.DictReader(open(sys.argv[1])))
M=['fixed-epsilon','waechter-binder','error-bounds','unmoved']
def show(f,g,key,cond):
    print(f,g,'by',key, ' crate test / plain')
    d={}
    for r in rows:
        if r['failure']==f and r['gap']==g and cond(r): d.setdefault(float(r[key]),{})[r['method']]=(int(r['trials']),int(r['failures']),int(r['failures_plain_test']))
    for k in sorted(d):
        t=d[k][M[0]][0]
        print(f'{k:6.0e} {t:7d} ', '  '.join(f'{m[:5]} {d[k][m][1]/t:.5f} {d[k][m][2]/t:.5f}' for m in M))
for f,g in [('self-hit',''),('lost-contact','1e-3'),('lost-contact','1e-5')]:
    show(f,g,'scale',lambda r: float(r['distance'])==0)
    show(f,g,'distance',lambda r: float(r['scale'])==1)
bad=[r for r in rows if r['failure']=='self-hit' and r['method']=='error-bounds' and r['failures']!='0']
print('ours bad',[(r['scale'],r['distance'],r['trials'],r['failures']) for r in bad])
